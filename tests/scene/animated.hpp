#pragma once

#include "gltf_builder.hpp"

#include <optional>
#include <string>
#include <vector>

namespace argand::testing_gltf {

/// A file with animations, which tests may change.
struct Animated {
    GltfBuilder builder;

    int add_floats(const std::vector<float>& numbers, const char* type, std::size_t count) {
        return builder.add_accessor(builder.add_view(numbers), float_type, type, count);
    }

    /// Moves a node by keys of three numbers.
    void animate(int node, const std::string& path, const std::vector<float>& times,
                 const std::vector<glm::vec3>& values) {
        const int input = add_floats(times, "SCALAR", times.size());
        const int output = builder.add_vectors(values);
        builder.root["animations"].push_back(
            {{"name", path},
             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}},
             {"samplers", {{{"input", input}, {"output", output}}}}});
    }

    Scene load(std::optional<double> seconds) const {
        const TempDirectory directory;
        return load_gltf(directory.write("scene.glb", builder.glb()), seconds);
    }
};

} // namespace argand::testing_gltf
