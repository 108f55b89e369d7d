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
    command.add_option("--scene", options.choice,
                       "Name or index of the scene, where the file has several (default: the one "
                       "that the file names, else the first)");
}

} // namespace argand
