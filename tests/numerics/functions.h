// The functions of the shared maths by number, behind one function that host, device and reference
// run.
#ifndef ARGAND_TEST_FUNCTIONS_H
#define ARGAND_TEST_FUNCTIONS_H

#include "codes_functions.h"
#include "light_functions.h"
#include "maths_functions.h"
#include "scatter_functions.h"

ARGAND_SHARED_BEGIN

FN Values evaluate(uint function, IN(Arguments) a) {
    if (function < end_of_maths) {
        return evaluate_maths(function, a);
    }
    if (function < end_of_scatter) {
        return evaluate_scatter(function, a);
    }
    return function < end_of_lights ? evaluate_lights(function, a) : evaluate_codes(function, a);
}

ARGAND_SHARED_END

#endif
