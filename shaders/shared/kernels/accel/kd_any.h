// Tells for each ray whether it hits any triangle, through a kd-tree.
#include "shared/kernels/accel/any_hit.h"
#include "shared/kernels/accel/kd_traverse.h"
