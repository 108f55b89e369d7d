#ifndef ARGAND_SHARED_CASTER_RECORDS_H
#define ARGAND_SHARED_CASTER_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Vertices of a moving caster of caustics, of which one invocation finds the box: a range of a list
// of their indices.
struct CasterPart {
    uint first, count;
};
// Few enough for lavapipe's loops.
CONSTANT uint most_vertices_of_caster_part = 512u;

struct CasterBoxParams {
    uint parts;
};

ARGAND_SHARED_END

#endif
