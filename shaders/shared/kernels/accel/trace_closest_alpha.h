// Finds the closest hit of each ray on what is present of the triangles.
#include "shared/kernels/accel/closest_alpha.h"
#include "shared/kernels/accel/traverse.h"
