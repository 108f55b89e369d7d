#pragma once

#include "methods/method_info.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace argand::testing {

/// Whether a built-in method estimates radiance from photons.
inline bool has_map(std::string_view method) {
    return builtin_methods().at(method).abilities.photon_map;
}

/// Whether it connects the hits of photons with the eye.
inline bool has_light_paths(std::string_view method) {
    return builtin_methods().at(method).abilities.light_paths;
}

/// Whether its paths come from the eye alone, which cannot hit delta lights.
inline bool has_eye_paths_only(std::string_view method) {
    return !has_map(method) && !has_light_paths(method);
}

/// Whether its images depend on those before them in the same session.
inline bool keeps_photons(std::string_view method) {
    return builtin_methods().at(method).abilities.keeps_photons;
}

/// Whether its photons find their hits in cube maps, whose size depends on the device.
inline bool has_approximate_hits(std::string_view method) {
    return builtin_methods().at(method).abilities.approximate_hits;
}

/// Those of these methods whose photons hit what rays hit.
inline std::vector<std::string> exact(std::vector<std::string> methods) {
    std::erase_if(methods, has_approximate_hits);
    return methods;
}

inline std::vector<std::string> exact_methods() { return exact(method_names()); }

inline std::vector<std::string> methods_with_map() {
    std::vector<std::string> names = method_names();
    std::erase_if(names, [](const std::string& name) { return !has_map(name); });
    return names;
}

} // namespace argand::testing
