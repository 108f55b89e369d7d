// Tells for each ray whether it hits any triangle.
#include "shared/kernels/accel/any_hit.h"
#include "shared/kernels/accel/traverse.h"
