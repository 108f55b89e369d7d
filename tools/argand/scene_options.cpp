#include "scene_options.hpp"

#include "numbers.hpp"

namespace argand {

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command.add_option("scene", options.scene, "glTF 2.0 file (.gltf, .glb)")->required();
    command
        .add_option("--at", options.seconds,
                    "Second of the scene's animations (default: the scene at rest). All animations "
                    "run at once, and stand still after their last key")
        ->check(number_between(-1e9, 1e9));
}

} // namespace argand
