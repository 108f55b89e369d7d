// Functions of simultaneous search (frontier_records.h).
#ifndef ARGAND_SHARED_FRONTIER_H
#define ARGAND_SHARED_FRONTIER_H

#include "shared/frontier_records.h"
#include "shared/geometry_records.h"

ARGAND_SHARED_BEGIN

// Whether a photon at p, which counts within `reach` along each axis, may count at a query in the
// box from low to high: whether it lies in the box of the queries' balls.
FN bool reaches(vec3 p, vec3 reach, vec3 low, vec3 high) {
    vec3 outside = max(low - p, p - high);
    return outside.x <= reach.x && outside.y <= reach.y && outside.z <= reach.z;
}

FN vec3 box_low(IN(BoxRecord) b) { return vec3(b.low_x, b.low_y, b.low_z); }
FN vec3 box_high(IN(BoxRecord) b) { return vec3(b.high_x, b.high_y, b.high_z); }

// The longest axis of the box of a node's queries.
struct LongestAxis {
    uint axis;
    real low, high;
};

FN LongestAxis longest_axis(IN(BoxRecord) b) {
    vec3 size = box_high(b) - box_low(b);
    LongestAxis along;
    along.axis = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
    along.low = along.axis == 0u ? b.low_x : along.axis == 1u ? b.low_y : b.low_z;
    along.high = along.axis == 0u ? b.high_x : along.axis == 1u ? b.high_y : b.high_z;
    return along;
}

// Whether a query is in the first part of its node: on the lower side of the middle. If not all
// queries lie in one point, neither part is empty.
FN bool is_in_first_part(vec3 p, IN(BoxRecord) queries) {
    LongestAxis along = longest_axis(queries);
    real at = along.axis == 0u ? p.x : along.axis == 1u ? p.y : p.z;
    real middle = along.low + real(0.5) * (along.high - along.low);
    return middle < along.high ? at <= middle : at < along.high;
}

// Whether the queries of a node are partitioned. After a partition each photon is compared with
// half of the queries, and in both parts if it lies within `reach` of the middle. With photons that
// are even over the box of the balls, which is `size` + 2 reach long, it is in (size / 2 + 2 reach)
// / (size + 2 reach) of the parts. So a partition saves `queries` times size / 2 / (size + 2 reach)
// comparisons of each photon, which must be worth more than its cost.
FN bool is_partitioned(uint queries, IN(BoxRecord) box, IN(FrontierParams) params) {
    LongestAxis along = longest_axis(box);
    real size = along.high - along.low;
    real saved = real(queries) * real(0.5) * size;
    return queries > params.query_leaf && size > real(0.0) &&
           saved >= params.cost * (size + real(2.0) * params.reach);
}

// What becomes of a node.
FN uint frontier_state(uint queries, uint photons, IN(BoxRecord) box, IN(FrontierParams) params) {
    return queries == 0u || photons == 0u         ? frontier_ended
           : is_partitioned(queries, box, params) ? frontier_active
                                                  : frontier_leaf;
}

// Chunks of a node's references.
FN uint chunks_of(uint references, uint chunk) { return (references + chunk - 1u) / chunk; }

ARGAND_SHARED_END

#endif
