#include "scene_options.hpp"

#include "numbers.hpp"

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
}

} // namespace argand
