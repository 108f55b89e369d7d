#include "shared/kernels/material.h"
#include "shared/kernels/passes_light.h"

// Finds the ray of an invocation. Returns false if it has none, or one that hits nothing.
FN bool find_hit(uint thread, OUT(uint) i) {
    i = 0u;
    if (thread >= counters[params.counter]) {
        return false;
    }
    alive[thread] = 0u;
    i = active_slots[thread];
    return hits[i].triangle != no_triangle;
}

// Moves the start of a ray behind its hit. `thread`: of the invocation.
FN void go_on_behind(uint thread, uint i, real t) {
    alive[thread] = 1u;
    real by = t + params.error;
    rays[i].origin_x += by * rays[i].direction_x;
    rays[i].origin_y += by * rays[i].direction_y;
    rays[i].origin_z += by * rays[i].direction_z;
    rays[i].t_max -= by;
}
