// Finds the closest triangle that each ray hits.
#include "shared/kernels/accel/closest_hit.h"
#include "shared/kernels/accel/traverse.h"
