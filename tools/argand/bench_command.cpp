#include "commands.hpp"

#include "backend_options.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/json.hpp"
#include "bench/bench.hpp"
#include "bench/bench_dynamic.hpp"
#include "bench/bench_photons.hpp"
#include "bench/bench_rays.hpp"
#include "bench/fd09.hpp"
#include "bench/kdgs10.hpp"
#include "bench/shi12.hpp"
#include "bench/ywcyp10.hpp"
#include "numbers.hpp"

#include <algorithm>
#include <memory>

namespace argand {

namespace {

struct BenchOptions {
    std::vector<std::string> names;
    std::string backend = "auto";
    std::string device;
    std::string paper;
    Fd09Settings fd09;
    Kdgs10Settings kdgs10;
    Shi12Options shi12;
    Ywcyp10Settings ywcyp10;
    bool is_dynamic = false;
    DynamicOptions dynamic;
    bool json = false;
};

struct NamedBench {
    const char* name;
    std::vector<BenchRow> (*measure)(Device&);
};

constexpr NamedBench benches[] = {
    {"parallel", bench_parallel}, {"rays", bench_rays}, {"photons", bench_photons}};

std::string names() {
    std::string all;
    for (const NamedBench& bench : benches) {
        all += (all.empty() ? "" : ", ") + std::string(bench.name);
    }
    return all;
}

void print(const BenchRow& row) {
    fmt::print("{:<28}{:>10}  {:>10.3g} s  {:>10.4g} {}", row.name, row.n, row.seconds, row.rate,
               row.unit);
    if (row.bound > 0) {
        fmt::print("  {:>5.1f} % of {:.4g}", 100 * row.rate / row.bound, row.bound);
    }
    if (!row.peer.empty()) {
        fmt::print("  {:.3g} x {} ({:.4g})", row.rate / row.peer_rate, row.peer, row.peer_rate);
    }
    fmt::print("\n");
}

nlohmann::ordered_json to_json(const BenchRow& row) {
    return {{"name", row.name},       {"n", row.n},
            {"seconds", row.seconds}, {"rate", row.rate},
            {"unit", row.unit},       {"bound", row.bound},
            {"peer", row.peer},       {"peer_rate", row.peer_rate}};
}

void run_paper(const BenchOptions& options) {
    if (options.paper == "shi12") {
        catch_interrupts();
        bench_shi12([&] { return open_backend(options.backend, options.device, true); },
                    options.shi12);
        return;
    }
    const std::unique_ptr<Device> device = open_backend(options.backend, options.device, false);
    const bool by_row = options.paper != "fd09";
    const std::vector<PaperTable> tables =
        options.paper == "kdgs10"    ? std::vector{bench_kdgs10(*device, options.kdgs10)}
        : options.paper == "ywcyp10" ? bench_ywcyp10(*device, options.ywcyp10)
                                     : bench_fd09(*device, options.fd09);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const PaperTable& table : tables) {
        for (nlohmann::ordered_json row : table.rows) {
            row["table"] = table.title;
            rows.push_back(row);
        }
    }
    if (options.json) {
        fmt::print("{}", json_text(rows));
        return;
    }
    for (const PaperTable& table : tables) {
        fmt::print("{}", by_row ? markdown_rows(table) : markdown(table));
    }
}

void run(const BenchOptions& options) {
    if (options.is_dynamic) {
        catch_interrupts();
        bench_dynamic([&] { return open_backend(options.backend, options.device, true); },
                      options.dynamic);
        return;
    }
    if (!options.paper.empty()) {
        run_paper(options);
        return;
    }
    for (const std::string& name : options.names) {
        if (std::none_of(std::begin(benches), std::end(benches),
                         [&](const NamedBench& b) { return name == b.name; })) {
            throw UsageError(fmt::format(
                "measuring '{}': there is no such benchmark; choose from {}", name, names()));
        }
    }
    const std::unique_ptr<Device> device = open_backend(options.backend, options.device, false);
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const NamedBench& bench : benches) {
        if (!options.names.empty() && std::find(options.names.begin(), options.names.end(),
                                                bench.name) == options.names.end()) {
            continue;
        }
        for (const BenchRow& row : bench.measure(*device)) {
            if (options.json) {
                rows.push_back(to_json(row));
            } else {
                print(row);
            }
        }
    }
    if (options.json) {
        fmt::print("{}", json_text(rows));
    }
}

/// Throws UsageError if an option is given that the benchmark of the paper does not have.
void check_paper_options(const CLI::App& command, const std::string& paper) {
    const std::vector<std::string> of_fd09{"--size", "--error-size", "--budget",
                                           "--reference-samples"};
    const std::vector<std::string> of_both{"--scene", "--photons", "--part"};
    const std::vector<std::string> of_kdgs10{"--most-queries", "--most-photons"};
    const std::vector<std::string> of_shi12{"--output", "--scenes", "--quick"};
    std::vector<std::string> others;
    const auto add = [&](const char* of, const std::vector<std::string>& names) {
        if (paper != of) {
            others.insert(others.end(), names.begin(), names.end());
        }
    };
    add("fd09", of_fd09);
    if (paper != "fd09" && paper != "ywcyp10") {
        others.insert(others.end(), of_both.begin(), of_both.end());
    }
    add("kdgs10", of_kdgs10);
    add("shi12", of_shi12);
    if (paper == "shi12") {
        others.emplace_back("--json"); // it writes files
    }
    for (const std::string& name : others) {
        if (command.count(name) > 0) {
            throw UsageError(
                fmt::format("measuring '{}': this paper has no {}; leave it out", paper, name));
        }
    }
}

/// Throws UsageError if the benchmark of the paper lacks one of these parts.
void check_parts(const std::vector<std::string>& parts, const std::string& paper) {
    const std::vector<std::string> known = paper == "fd09" ? fd09_parts() : ywcyp10_parts();
    for (const std::string& part : parts) {
        if (std::find(known.begin(), known.end(), part) == known.end()) {
            throw UsageError(fmt::format("reading --part: '{}' has no part '{}'; choose from {}",
                                         paper, part, fmt::join(known, ", ")));
        }
    }
}

/// Throws UsageError if scenes or photons are given, and no part of Yao et al. 2010 uses them.
void check_loads(const CLI::App& command, const BenchOptions& options) {
    const std::vector<std::string>& parts = options.fd09.parts;
    const bool uses = options.paper != "ywcyp10" || parts.empty() ||
                      std::find(parts.begin(), parts.end(), "hits") != parts.end();
    if (!uses && (command.count("--scene") > 0 || command.count("--photons") > 0)) {
        throw UsageError("measuring 'ywcyp10': --scene and --photons are for --part hits; leave "
                         "them out");
    }
}

/// Throws UsageError if an option is given that only benchmarks of films have.
void check_film_options(const CLI::App& command) {
    for (const char* name : {"--output", "--scenes", "--quick"}) {
        if (command.count(name) > 0) {
            throw UsageError(fmt::format(
                "measuring: {} is for --dynamic and --paper shi12; leave it out", name));
        }
    }
}

} // namespace

void add_bench_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("bench", "Measure the speed of the parts on a device");
    auto options = std::make_shared<BenchOptions>();
    command->add_option("name", options->names, fmt::format("Any of {} (default: all)", names()));
    add_backend_options(*command, options->backend, options->device);
    Fd09Settings& fd09 = options->fd09;
    CLI::Option* paper =
        command
            ->add_option(
                "--paper", options->paper,
                "Repeat the measurements of a paper instead: fd09, Fabianowski and Dingliana 2009; "
                "kdgs10, Keller et al. 2010; shi12, Shi 2012, which resumes if it is interrupted; "
                "ywcyp10, Yao et al. 2010")
            ->check(CLI::IsMember({"fd09", "kdgs10", "shi12", "ywcyp10"}));
    command
        ->add_option("--scene", fd09.scenes,
                     "With --paper fd09 and ywcyp10: glTF files (default: scenes of this project)")
        ->needs(paper)
        ->check(CLI::ExistingFile);
    command
        ->add_option("--part", fd09.parts,
                     fmt::format("With --paper fd09: {}; with ywcyp10: {} (default: all)",
                                 fmt::join(fd09_parts(), ", "), fmt::join(ywcyp10_parts(), ", ")))
        ->needs(paper);
    command
        ->add_option("--size", fd09.size,
                     "With --paper fd09: pixels per side of pictures that measure speed")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(1, 4096));
    command
        ->add_option("--error-size", fd09.error_size,
                     "With --paper fd09: pixels per side of pictures that measure error")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(1, 4096));
    command
        ->add_option("--budget", fd09.budgets,
                     "With --paper fd09: times at which errors are compared, in seconds")
        ->needs(paper)
        ->capture_default_str()
        ->check(number_between(1e-3, 1e5));
    command
        ->add_option(
            "--photons", fd09.photons,
            "With --paper fd09 and ywcyp10: photons emitted (default: as in the paper; with "
            "ywcyp10 20,000)")
        ->needs(paper)
        ->check(integer_between(1, 4'000'000));
    command
        ->add_option("--reference-samples", fd09.reference_samples,
                     "With --paper fd09: samples per pixel of each of the two references")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(1, 1 << 20));
    command
        ->add_option("--runs", fd09.runs,
                     "With --paper: number of interleaved runs; the median counts")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(1, 101));
    command
        ->add_option("--most-queries", options->kdgs10.most_queries,
                     "With --paper kdgs10: queries of the largest load")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(1000, 10'000'000));
    command
        ->add_option("--most-photons", options->kdgs10.most_photons,
                     "With --paper kdgs10: photons of the largest load")
        ->needs(paper)
        ->capture_default_str()
        ->check(integer_between(10'000, 10'000'000));
    DynamicOptions& dynamic = options->dynamic;
    CLI::Option* is_dynamic =
        command
            ->add_flag("--dynamic", options->is_dynamic,
                       "Measure time and error of the frames of films in which lights, objects and "
                       "the camera move, by every method; an interrupted measurement resumes")
            ->excludes(paper);
    command
        ->add_option("--film", dynamic.films,
                     "With --dynamic: names of films, such as dynamic_shi (default: all)")
        ->needs(is_dynamic);
    command
        ->add_option("--scenes", dynamic.scenes,
                     "With --dynamic and --paper shi12: folder of this project's scenes")
        ->capture_default_str();
    command->add_option(
        "-o,--output", dynamic.folder,
        "With --dynamic: folder for dynamic.csv, FILM.json and the references "
        "(default: argand_dynamic); with --paper shi12: for shi12.md and shi12.json "
        "(default: argand_shi12)");
    command->add_flag("--quick", dynamic.quick,
                      "With --dynamic and --paper shi12: small pictures and few photons, for a few "
                      "minutes");
    command->add_flag("--json", options->json, "Print JSON, one object per measurement")
        ->excludes(is_dynamic);
    command->footer("Rates are items per second of device time, the median of several runs. The "
                    "bound is the rate that memory\n"
                    "traffic alone would allow at the copy rate of the same run. The peer does the "
                    "same work on the host.\n\nExample:\n  argand bench parallel --json\n"
                    "  argand bench --paper fd09 --part table1 --scene assets/ring.glb");
    command->callback([options, command] {
        if (!options->paper.empty()) {
            check_paper_options(*command, options->paper);
            check_parts(options->fd09.parts, options->paper);
            check_loads(*command, *options);
        } else if (!options->is_dynamic) {
            check_film_options(*command);
        }
        options->ywcyp10.scenes = options->fd09.scenes;
        options->ywcyp10.parts = options->fd09.parts;
        if (options->fd09.photons > 0) {
            options->ywcyp10.photons = options->fd09.photons;
        }
        options->ywcyp10.runs = options->kdgs10.runs = options->shi12.runs = options->fd09.runs;
        options->shi12.scenes = options->dynamic.scenes;
        options->shi12.quick = options->dynamic.quick;
        if (command->count("--output") > 0) {
            options->shi12.folder = options->dynamic.folder;
        }
        run(*options);
    });
}

} // namespace argand
