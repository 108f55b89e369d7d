#include "commands.hpp"

#include "base/error.hpp"
#include "base/json.hpp"
#include "image/files.hpp"
#include "image/metrics.hpp"
#include "overwriting.hpp"

#include <array>
#include <memory>

namespace argand {

namespace {

using Json = nlohmann::ordered_json;

struct CompareOptions {
    std::string a, b, layer, output;
    bool json = false;
};

const Image& layer_of(const std::vector<Layer>& layers, const std::string& path,
                      const std::string& name) {
    const Image* image = find_layer(layers, name);
    if (!image) {
        std::string names;
        for (const Layer& layer : layers) {
            names += fmt::format(" '{}'", layer.name);
        }
        fail("comparing '{}': it has no layer '{}', only{}", path, name, names);
    }
    return *image;
}

/// relMSE against the reference of a sweep (`argand tradeoff`), which has two independent halves as
/// layers, so that its noise does not count as error. Null if `reference` has no halves.
Json rel_mse_of_pair(const Image& a, const std::vector<Layer>& reference) {
    const Image* first = find_layer(reference, "a");
    const Image* second = find_layer(reference, "b");
    return first && second ? Json(rel_mse(a, *first, *second)) : Json(nullptr);
}

void compare_files(const CompareOptions& options) {
    if (!options.output.empty()) {
        check_overwrites_none(options.output, {options.a, options.b});
        check_image_writable(options.output);
    }
    const std::vector<Layer> layers_a = read_image(options.a);
    const std::vector<Layer> layers_b = read_image(options.b);
    const Image& a = layer_of(layers_a, options.a, options.layer);
    const Image& b = layer_of(layers_b, options.b, options.layer);
    const Metrics metrics = compare(a, b, options.a, options.b);
    if (!options.output.empty()) {
        const std::array<Layer, 1> picture{
            Layer{"", difference_picture(a, b, options.a, options.b)}};
        write_image(options.output, picture);
    }
    const Json of_pair = options.layer.empty() ? rel_mse_of_pair(a, layers_b) : Json(nullptr);
    if (options.json) {
        fmt::print("{}",
                   json_text({{"a", options.a},
                              {"b", options.b},
                              {"layer", options.layer},
                              {"relMSE", metrics.rel_mse},
                              {"relMSE_without_reference_noise", of_pair},
                              {"RMSE", metrics.rmse},
                              {"MAE", metrics.mae},
                              {"PSNR", metrics.psnr},
                              {"SSIM", metrics.ssim},
                              {"mean_a", {metrics.mean_a.r, metrics.mean_a.g, metrics.mean_a.b}},
                              {"mean_b", {metrics.mean_b.r, metrics.mean_b.g, metrics.mean_b.b}}}));
        return;
    }
    fmt::print("relMSE {:.6g}\nRMSE   {:.6g}\nMAE    {:.6g}\nPSNR   {:.4g} dB\nSSIM   {:.5f}\n",
               metrics.rel_mse, metrics.rmse, metrics.mae, metrics.psnr, metrics.ssim);
    if (!of_pair.is_null()) {
        fmt::print("relMSE without the reference's noise {:.6g}\n", of_pair.get<double>());
    }
    fmt::print("mean A {:.6g} {:.6g} {:.6g}\nmean B {:.6g} {:.6g} {:.6g}\n", metrics.mean_a.r,
               metrics.mean_a.g, metrics.mean_a.b, metrics.mean_b.r, metrics.mean_b.g,
               metrics.mean_b.b);
}

} // namespace

void add_compare_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("compare", "Measure how far a picture is from a reference");
    auto options = std::make_shared<CompareOptions>();
    command->add_option("a", options->a, "Picture (.exr, .png, .hdr)")->required();
    command->add_option("b", options->b, "Reference of the same size")->required();
    command->add_option("--layer", options->layer,
                        "Compare this layer of both: direct, indirect or caustic");
    command->add_option("-o,--output", options->output,
                        "Write a picture of the difference (.png, .exr)");
    command->add_flag("--json", options->json, "Print JSON");
    command->footer("relMSE = mean((a - b)^2 / (b^2 + 0.01 mean(b)^2)).\n\n"
                    "Example:\n  argand compare photons.exr path.exr -o difference.png");
    command->callback([options] { compare_files(*options); });
}

} // namespace argand
