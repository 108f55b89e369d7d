#define ARGAND_REAL_DOUBLE
#include "truth.hpp"

#include "functions.h"

#include <bit>

namespace argand::truth {

Outputs evaluate(unsigned function, const Inputs& inputs) {
    return std::bit_cast<Outputs>(
        oracle::evaluate(function, std::bit_cast<oracle::Arguments>(inputs)));
}

} // namespace argand::truth
