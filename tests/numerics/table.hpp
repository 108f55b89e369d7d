#pragma once

#include "draw.hpp"

#include <vector>

namespace argand::testing {

/// What bounds an error.
enum class Measure {
    ulp,        ///< units in the last place of the result (of a vector: of its length)
    conditioned ///< what half a unit in the last place of every input and of the result makes of
                ///< the result
};

/// One function of the shared maths. A further one is a row here and a case in one of
/// *_functions.h.
struct Function {
    const char* name;
    unsigned id;              ///< of_*
    const char* inputs;       ///< in words
    void (*draw)(Draw& draw); ///< puts the inputs
    int rounded; ///< so many inputs, the first ones, are rounded numbers; the others are exact
    const char*
        parts; ///< of the results: d a decision, c a cell's number, 1 a number, 2, 3 or 6 a vector
    Measure measure;
    double bound; ///< of the measure; decisions differ from the truth's only where rounding the
                  ///< inputs makes the truth's differ
    double borderline = 0.015; ///< so large a share of the cases at most may be such; more where
                               ///< inputs are drawn from there on purpose
};

std::vector<Function> maths_table();
std::vector<Function> scatter_table();
std::vector<Function> light_table();
std::vector<Function> codes_table();

} // namespace argand::testing
