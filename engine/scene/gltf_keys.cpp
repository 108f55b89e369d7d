#include "scene/gltf_keys.hpp"

#include "scene/gltf_accessor.hpp"
#include <cmath>

namespace argand {
namespace {

Interpolation interpolation_of(const GltfSource& source, const std::string& name,
                               const std::string& what) {
    if (name == "LINEAR" || name.empty()) {
        return Interpolation::linear;
    }
    if (name == "STEP") {
        return Interpolation::step;
    }
    if (name == "CUBICSPLINE") {
        return Interpolation::cubic_spline;
    }
    source.fail("{} has the interpolation \"{}\", which glTF does not know", what,
                one_line(name, 40));
}

std::vector<double> read_times(const GltfSource& source, int accessor, const std::string& what) {
    const GltfAccessor input = open_accessor(source, accessor, "the times of " + what);
    if (input.components != 1 || input.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) {
        source.fail("the times of {} are not floating-point numbers", what);
    }
    if (input.count == 0) {
        source.fail("{} has no keys", what);
    }
    std::vector<double> times(input.count);
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = read_component(input, i, 0);
        if (!std::isfinite(times[i]) || (i > 0 && !(times[i] > times[i - 1]))) {
            source.fail("the times of {} do not rise: key {} is at {} s", what, i, times[i]);
        }
    }
    return times;
}

/// Throws Error unless the value of every key is a rotation.
void check_rotations(const GltfSource& source, const KeyFrames& keys, const std::string& what) {
    for (const double time : keys.times) {
        const std::vector<double> r = value_at(keys, time);
        if (!(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3] > 0)) {
            source.fail("the rotation of {} at {} s is not a unit quaternion", what, time);
        }
    }
}

} // namespace

KeyFrames read_keys(const GltfSource& source, const tinygltf::AnimationSampler& sampler,
                    const KeyTarget& target, const std::string& what, std::size_t& numbers_left) {
    KeyFrames keys;
    keys.width = std::size_t(target.components) * target.elements;
    keys.interpolation = interpolation_of(source, sampler.interpolation, what);
    keys.times = read_times(source, sampler.input, what);
    const GltfAccessor output = open_accessor(source, sampler.output, "the values of " + what);
    const std::size_t expected = keys.times.size() * target.elements *
                                 (keys.interpolation == Interpolation::cubic_spline ? 3 : 1);
    if (output.components != target.components || output.count != expected) {
        source.fail("{} has {} values of {} numbers, but its {} keys need {} of {}", what,
                    output.count, output.components, keys.times.size(), expected,
                    target.components);
    }
    const std::size_t numbers = expected * std::size_t(target.components);
    if (numbers > numbers_left) {
        source.fail("the keys of its animations have more than {} numbers", most_key_numbers);
    }
    numbers_left -= numbers;
    if (output.component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT ||
        (output.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT && !output.normalized)) {
        source.fail("the values of {} are neither floating-point nor normalised numbers", what);
    }
    keys.values.reserve(numbers);
    for (std::size_t i = 0; i < expected; ++i) {
        for (int k = 0; k < target.components; ++k) {
            keys.values.push_back(read_component(output, i, k));
            if (!std::isfinite(keys.values.back())) {
                source.fail("value {} of {} is not finite", i, what);
            }
        }
    }
    if (target.rotation) {
        check_rotations(source, keys, what);
    }
    return keys;
}

} // namespace argand
