#include "commands.hpp"

#include "base/json.hpp"
#include "scene/gltf.hpp"
#include "scene/summary.hpp"

#include <fmt/format.h>
#include <memory>

namespace argand {

namespace {

struct InspectOptions {
    std::string scene;
    bool json = false;
};

void inspect(const InspectOptions& options) {
    const Scene scene = load_gltf(options.scene);
    fmt::print("{}", options.json ? json_text(summary_json(scene)) : summary_text(scene));
}

} // namespace

void add_inspect_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("inspect", "Say what is in a scene, and what of it is not understood");
    auto options = std::make_shared<InspectOptions>();
    command->add_option("scene", options->scene, "glTF 2.0 file (.gltf, .glb)")->required();
    command->add_flag("--json", options->json, "Print JSON");
    command->footer("Example:\n  argand inspect assets/cornell_glass.glb");
    command->callback([options] { inspect(*options); });
}

} // namespace argand
