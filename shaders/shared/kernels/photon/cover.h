#include "shared/kernels/material.h"
#include "shared/kernels/passes_light.h"

// Moves the start of a ray behind its hit. `thread`: of the invocation.
FN void go_on_behind(uint thread, uint i, real t) {
    alive[thread] = 1u;
    real by = t + params.error;
    rays[i].origin_x += by * rays[i].direction_x;
    rays[i].origin_y += by * rays[i].direction_y;
    rays[i].origin_z += by * rays[i].direction_z;
    rays[i].t_max -= by;
}
