// Finds the closest triangle that each ray hits, through a kd-tree.
#include "shared/kernels/accel/closest_hit.h"
#include "shared/kernels/accel/kd_traverse.h"
