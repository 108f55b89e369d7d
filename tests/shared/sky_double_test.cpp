#define ARGAND_REAL_DOUBLE
#include "sky_case.hpp"
