#include "scene_options.hpp"

#include "base/error.hpp"
#include "base/json.hpp"
#include "numbers.hpp"
#include "scene/find_named.hpp"
#include "scene/pose.hpp"
#include "scene/scene_editor.hpp"

namespace argand {

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, "glTF 2.0 file (.gltf, .glb)")->required();
    command
        .add_option("--at", options.seconds,
                    "Time in the scene's animations, in seconds (default: the scene at rest). All "
                    "animations run at once; each stands still before its first key and after its "
                    "last one")
        ->check(number_between(-1e9, 1e9));
    add_environment_options(command, options);
    command.add_flag("--allow-external", options.load.allow_external,
                     "Read buffers and images that are outside the scene's folder");
    command
        .add_option_function<std::string>(
            "--missing-textures",
            [&options](const std::string& choice) {
                options.load.grey_for_missing = choice == "grey";
            },
            "What to do where an image's file does not exist (default: error)")
        ->check(CLI::IsMember({"error", "grey"}));
    command.add_option("--scene", options.load.scene,
                       "Name or index of the scene, where the file has several (default: the one "
                       "that the file names, else the first)");
    command.add_option(
        "--edits", options.edits,
        "JSON file of changes to nodes, lights, materials, cameras and the sun, such "
        "as {\"lights\": {\"lamp\": {\"position\": [0, 1, 0]}}}; see docs/edits.md");
}

Scene load_scene(const SceneOptions& options, std::optional<double> seconds) {
    if (options.edits.empty()) {
        return load_scene(options.scene, options, seconds, options.load);
    }
    const Edits edits = parse_edits(read_json(options.edits), options.edits);
    LoadOptions load = options.load;
    load.movable_nodes = edits.has_nodes;
    Scene scene = load_scene(options.scene, options, seconds, load);
    SceneEditor(scene).apply(edits, scene);
    move_to(seconds, scene);
    return scene;
}

std::size_t find_camera(const Scene& scene, const std::string& choice) {
    if (choice.empty()) {
        return 0;
    }
    if (const std::optional<std::size_t> index = find_named(scene.cameras, choice)) {
        return *index;
    }
    fail("choosing camera '{}' of '{}': there is none of that name or index; `argand inspect` "
         "lists its {} cameras",
         choice, scene.name, scene.cameras.size());
}

} // namespace argand
