#pragma once

#include "methods/method_info.hpp"

#include <string_view>

namespace argand::testing {

/// Whether a built-in method estimates radiance from photons.
inline bool has_map(std::string_view method) {
    return builtin_methods().at(method).abilities.photon_map;
}

/// Whether its paths come from the eye alone, which cannot hit delta lights.
inline bool is_unbiased(std::string_view method) {
    return builtin_methods().at(method).abilities.unbiased;
}

/// Whether its images depend on those before them in the same session.
inline bool keeps_photons(std::string_view method) {
    return builtin_methods().at(method).abilities.keeps_photons;
}

} // namespace argand::testing
