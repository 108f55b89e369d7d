#include "commands.hpp"

#include "backend_options.hpp"
#include "base/atomic_write.hpp"
#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/machine.hpp"
#include "base/progress.hpp"
#include "base/read_file.hpp"
#include "environment_options.hpp"
#include "method_options.hpp"
#include "numbers.hpp"
#include "picture_size.hpp"
#include "plot/page.hpp"
#include "plot/plot.hpp"
#include "scene/fingerprint.hpp"
#include "sweep/tradeoff.hpp"

#include <memory>
#include <optional>

namespace argand {

namespace {

struct TradeoffOptions {
    MethodTable table;
    std::string scene;
    EnvironmentOptions sky;
    std::string folder;
    std::string size = "128x128";
    std::string backend = "auto";
    std::string device;
    std::string reference, second_reference;
    std::string replot;
    bool quick = false;
    bool quiet = false;
    TradeoffRequest request;
};

void check(const TradeoffOptions& options) {
    check_methods(options.request.methods, options.table);
    if (options.reference.empty() && !options.second_reference.empty()) {
        throw UsageError(
            "reading --reference-2: it requires --reference, the other picture of the pair");
    }
}

void summarise(const Results& results, const std::filesystem::path& folder) {
    fmt::print("{:<13} {:<26} {:>8} {:>10}  {}\n", "method", "option", "wall, s", "relMSE",
               "argand render ...");
    for (const std::size_t i : front_of(results)) {
        const Measurement& m = results.measurements[i];
        const std::string error = m.rel_mse.mean < results.least_error
                                      ? fmt::format("<{:.2g}", results.least_error)
                                      : fmt::format("{:.3g}", m.rel_mse.mean);
        fmt::print("{:<13} {:<26} {:>8.3g} {:>10}  {}\n", m.method, m.option + " " + m.value,
                   m.wall_seconds, error, m.options);
    }
    fmt::print("{}: {} settings measured, those on the Pareto front above\n",
               (folder / "tradeoff.html").string(), results.measurements.size());
}

/// Completes the request with everything that follows from the options.
void read_request(TradeoffOptions& options) {
    TradeoffRequest& request = options.request;
    const PictureSize size = parse_picture_size(options.size);
    request.base.width = size.width;
    request.base.height = size.height;
    request.extent = options.quick ? Extent::quick : Extent::full;
    check(options);
    for (const std::string& file : {options.reference, options.second_reference}) {
        if (!file.empty()) {
            request.reference_files.emplace_back(file);
        }
    }
    request.folder =
        options.folder.empty()
            ? std::filesystem::path(options.scene).filename().replace_extension(".tradeoff")
            : std::filesystem::path(options.folder);
}

/// Draws the plot of a CSV file beside it, without measuring anything.
void replot(const TradeoffOptions& options) {
    const TradeoffRequest& request = options.request;
    Results results = read_csv(options.replot);
    results.run = {{"scene", std::filesystem::path(options.scene).filename().string()}};
    if (!request.reference_files.empty()) {
        const Reference reference =
            read_reference(request.reference_files, request.base.width, request.base.height);
        results.reference_error = reference.own_error;
        results.least_error = least_error_of(reference);
    }
    const std::filesystem::path plot =
        std::filesystem::path(options.replot).replace_extension(".svg");
    write_atomically(plot, to_svg_file(lay_out(results, options.table)));
    if (!options.quiet) {
        fmt::print("{}: {} settings plotted\n", plot.string(), results.measurements.size());
    }
}

/// The results of the sweep, shown as they progress.
Results measure(const TradeoffOptions& options, const Scene& scene) {
    const RenderTrials render =
        trials_on_device([&] { return open_backend(options.backend, options.device, true); }, scene,
                         [] { return !interrupted(); }, options.table);
    std::optional<Progress> progress;
    std::string shown;
    return measure_tradeoff(options.request, scene, render,
                            [&](std::string_view work, double done) {
                                if (work != shown) {
                                    progress.reset();
                                    progress.emplace(std::string(work), options.quiet);
                                    shown = work;
                                }
                                progress->update(done);
                            });
}

void run(TradeoffOptions& options) {
    read_request(options);
    if (!options.replot.empty()) {
        replot(options);
        return;
    }
    TradeoffRequest& request = options.request;
    catch_interrupts();
    const Scene scene = load_scene(options.scene, options.sky);
    const std::vector<std::uint8_t> file = read_file(options.scene);
    const std::uint64_t contents = fingerprint(scene, fingerprint(std::as_bytes(std::span(file))));
    const DeviceInfo device = open_backend(options.backend, options.device, options.quiet)->info();
    request.run = {{"scene", scene.name},       {"contents", fmt::format("{:016x}", contents)},
                   {"argand", ARGAND_VERSION},  {"build", program_fingerprint()},
                   {"backend", device.backend}, {"device", device.name},
                   {"driver", device.driver}};
    const Results results = measure(options, scene);
    draw_results(request.folder, results, options.table);
    if (!results.complete) {
        fail("measuring '{}': interrupted after {} settings; the same command resumes",
             options.scene, results.measurements.size());
    }
    for (const Failure& failure : results.failures) {
        fmt::print(stderr, "argand: note: not rendered: {}: {}\n", failure.options, failure.why);
    }
    if (!options.quiet) {
        summarise(results, request.folder);
    }
}

} // namespace

void add_tradeoff_command(CLI::App& app, MethodTable methods) {
    CLI::App* command = app.add_subcommand(
        "tradeoff", "Measure error against time of all methods and their options on a scene");
    auto options = std::make_shared<TradeoffOptions>(TradeoffOptions{.table = methods});
    TradeoffRequest& request = options->request;
    request.methods = methods.names();
    request.table = methods;
    command->add_option("scene", options->scene, "glTF 2.0 file (.gltf, .glb)")->required();
    add_environment_options(*command, options->sky);
    command->add_option("-o,--output", options->folder,
                        "Folder for tradeoff.html, .svg, .csv and .json, the reference and all "
                        "pictures; settings measured there already are skipped (default: SCENE's "
                        "name with .tradeoff)");
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command
        ->add_option("--seeds", request.seeds,
                     "Renders of each setting; at least 2 separate bias from variance")
        ->capture_default_str()
        ->check(integer_between(1, 1000));
    command->add_option(
        "--reference", options->reference,
        "Picture that counts as true (.exr) (default: two renders with a method without bias)");
    command->add_option(
        "--reference-2", options->second_reference,
        "A second one with independent noise, so that their noise does not count as error");
    command
        ->add_option("--reference-seconds", request.reference_seconds,
                     "Approximate time limit for rendering the reference; an existing one is kept")
        ->capture_default_str()
        ->check(number_between(0, 1e7));
    command
        ->add_option("--methods", request.methods,
                     fmt::format("{}", fmt::join(methods.names(), ",")))
        ->delimiter(',');
    command->add_flag("--quick", options->quick,
                      "Vary only numbers of photons and samples, and bandwidths");
    command->add_option("--replot", options->replot,
                        "Only draw the plot of this tradeoff.csv again, as .svg beside it; with "
                        "--reference and --reference-2 it shows their noise");
    add_backend_options(*command, options->backend, options->device);
    command->add_flag("-q,--quiet", options->quiet, "Print errors only");
    command->footer(
        "docs/tradeoff.md explains the plot. An interrupted sweep resumes when the same "
        "command runs again.\n\n"
        "Example:\n  argand tradeoff assets/cornell_area.glb -o sweep --quick");
    command->callback([options] { run(*options); });
}

} // namespace argand
