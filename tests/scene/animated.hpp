#pragma once

#include "gltf_builder.hpp"

#include <map>
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

    /// Moves what a pointer names by keys of floating-point numbers. type: of an element.
    void animate_pointer(const std::string& pointer, const std::vector<float>& times,
                         const char* type, const std::vector<float>& numbers,
                         const char* interpolation = "LINEAR") {
        const std::map<std::string, std::size_t> widths{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
        const int input = add_floats(times, "SCALAR", times.size());
        const int output = add_floats(numbers, type, numbers.size() / widths.at(type));
        const json target{{"path", "pointer"},
                          {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        builder.root["animations"].push_back(
            {{"channels", {{{"sampler", 0}, {"target", target}}}},
             {"samplers",
              {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}});
    }

    Scene load(std::optional<double> seconds) const {
        const TempDirectory directory;
        return load_gltf(directory.write("scene.glb", builder.glb()), seconds);
    }
};

} // namespace argand::testing_gltf
