// Finds for each ray how much light passes the triangles that it meets.
#include "shared/kernels/accel/any_alpha.h"
#include "shared/kernels/accel/kd_traverse.h"
