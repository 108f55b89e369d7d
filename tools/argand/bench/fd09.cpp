#include "fd09.hpp"

#include "base/error.hpp"
#include "scene/gltf.hpp"

#include <algorithm>
#include <filesystem>

namespace argand {

namespace {

constexpr const char* own_scenes[] = {"cornell_point", "cornell_area", "cornell_mirror",
                                      "cornell_glass", "ring",         "courtyard",
                                      "glossy",        "spot"};
constexpr std::uint32_t bounces = 2;

/// The paper's number of photons for a scene of this name, or else for its small scenes.
std::uint64_t photons_in_paper(const std::string& name) {
    return name.starts_with("sibenik") ? 512'000 : name.starts_with("sponza") ? 256'000 : 128'000;
}

std::string cell(const nlohmann::ordered_json& value) {
    return value.is_number_float() ? fmt::format("{:.4g}", value.get<double>())
           : value.is_string()     ? value.get<std::string>()
                                   : value.dump();
}

} // namespace

std::vector<std::string> scene_files(const std::vector<std::string>& given,
                                     std::span<const char* const> own) {
    std::vector<std::string> found = given;
    if (found.empty()) {
        for (const char* name : own) {
            const std::string file = fmt::format("assets/{}.glb", name);
            if (!std::filesystem::exists(file)) {
                fail("measuring '{}': there is no such file here; run in the project's folder, or "
                     "name scenes with --scene",
                     file);
            }
            found.push_back(file);
        }
    }
    return found;
}

std::vector<std::string> fd09_parts() {
    return {"table1", "table2", "table3", "figure4", "figure5", "budgets"};
}

std::vector<PaperTable> bench_fd09(Device& device, const Fd09Settings& settings) {
    const auto includes = [&](const char* part) {
        return settings.parts.empty() || std::find(settings.parts.begin(), settings.parts.end(),
                                                   part) != settings.parts.end();
    };
    TreeTables trees;
    PaperTable estimators{"Table 2: time at equal error"};
    PaperTable radii{"Table 3: footprints by radius, r_max = 0.7"};
    PaperTable kernels{"Figure 4: kernels"};
    PaperTable shares{"Figure 5: where the time goes"};
    PaperTable budgets{"Error at equal time"};
    for (const std::string& file : scene_files(settings.scenes, own_scenes)) {
        Scene scene = load_gltf(file);
        scene.name = std::filesystem::path(file).stem().string();
        RenderSettings render;
        render.width = render.height = settings.size;
        render.samples = 1;
        render.bounces = bounces;
        render.photons = settings.photons > 0 ? settings.photons : photons_in_paper(scene.name);
        if (includes("table1")) {
            measure_trees(device, scene, render, settings.runs, trees);
        }
        if (includes("table3")) {
            measure_radii(device, scene, render, radii);
        }
        if (includes("figure5")) {
            measure_shares(device, scene, render, settings.runs, shares);
        }
        if (includes("budgets")) {
            RenderSettings whole;
            whole.width = whole.height = settings.size;
            measure_budgets(device, scene, whole, settings.budgets, settings.reference_samples,
                            budgets);
        }
        if (includes("table2") || includes("figure4")) {
            render.width = render.height = settings.error_size;
            render.samples = 8;
            render.query_cell = 0; // every point queries the map, to compare estimators alone
            measure_errors(device, scene, render, settings.reference_samples, estimators, kernels);
        }
    }
    std::vector<PaperTable> tables;
    for (PaperTable* table : {&trees.linear, &trees.heuristic, &trees.builds, &estimators, &radii,
                              &kernels, &shares, &budgets}) {
        if (!table->rows.empty()) {
            tables.push_back(std::move(*table));
        }
    }
    return tables;
}

std::string markdown(const PaperTable& table) {
    std::string text = fmt::format("## {}\n\n", table.title);
    bool first = true;
    for (const auto& item : table.rows.front().items()) {
        text += fmt::format("| {} |", item.key());
        for (const nlohmann::ordered_json& row : table.rows) {
            text += fmt::format(" {} |", cell(row.at(item.key())));
        }
        text += '\n';
        if (first) {
            text += "| --- |";
            for (std::size_t i = 0; i < table.rows.size(); ++i) {
                text += " ---: |";
            }
            text += '\n';
        }
        first = false;
    }
    return text + '\n';
}

std::string markdown_rows(const PaperTable& table) {
    std::string text = fmt::format("## {}\n\n|", table.title);
    std::string rule = "|";
    for (const auto& item : table.rows.front().items()) {
        text += fmt::format(" {} |", item.key());
        rule += " ---: |";
    }
    text += '\n' + rule + '\n';
    for (const nlohmann::ordered_json& row : table.rows) {
        text += '|';
        for (const auto& item : row.items()) {
            text += fmt::format(" {} |", cell(item.value()));
        }
        text += '\n';
    }
    return text + '\n';
}

} // namespace argand
