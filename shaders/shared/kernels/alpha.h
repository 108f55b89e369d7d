#include "shared/kernels/texel_lookup.h"

#include "shared/kernels/coverage.h"
