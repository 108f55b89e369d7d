#pragma once

#include "draw.hpp"

#include <initializer_list>
#include <vector>

namespace argand::testing {

/// Unit of an error's bound.
enum class Measure {
    ulp, ///< units in the last place of the result; for a vector, of its length
    /// Change of the result when half a unit in the last place is added to every input and to the
    /// result.
    conditioned
};

/// A function of the shared maths. To add one, add a row to a table and a case to one of
/// *_functions.h.
struct Function {
    const char* name;
    unsigned id;              ///< of_*
    const char* inputs;       ///< description
    void (*draw)(Draw& draw); ///< draws the inputs
    /// Number of leading inputs that are rounded numbers; all others are exact.
    int rounded;
    /// Kinds of the results: d a decision, c the number of a cell, 1 a number, 2, 3 or 6 a vector.
    const char* parts;
    Measure measure;
    /// Bound in units of `measure`. Decisions may differ from the reference's only in borderline
    /// cases, where rounding the inputs changes the reference's decision.
    double bound;
    /// Largest share of borderline cases; higher if inputs are drawn from borderlines on purpose.
    double borderline = 0.015;
};

/// One table after another.
inline std::vector<Function> joined(std::initializer_list<std::vector<Function>> parts) {
    std::vector<Function> all;
    for (const std::vector<Function>& part : parts) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

std::vector<Function> maths_table();
std::vector<Function> scatter_table();
std::vector<Function> light_table();
std::vector<Function> codes_table();

} // namespace argand::testing
