#pragma once

#include "sweep/dynamic.hpp"

#include <string>
#include <vector>

namespace argand {

/// What the user asked `argand bench --dynamic` for.
struct DynamicOptions {
    std::string scenes = "assets";         ///< folder of the films' files
    std::string folder = "argand_dynamic"; ///< for results and references
    std::vector<std::string> films;        ///< names; empty: all
    bool quick = false;
};

/// Measures the frames of films by every method. Writes for each film FILM.json, and dynamic.csv of
/// all films in the folder; films that are measured there already are skipped. Throws Error if it
/// is interrupted, or if a film's file is missing.
void bench_dynamic(const OpenDevice& open, const DynamicOptions& options,
                   MethodTable methods = builtin_methods());

} // namespace argand
