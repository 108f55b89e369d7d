#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/geometry_records.h"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Distances { uint distances[]; };
layout(set = 0, binding = 2) readonly buffer Leaves { uint leaves[]; };
layout(set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) writeonly buffer Boxes { BoxRecord boxes[]; };
layout(set = 0, binding = 5) writeonly buffer LeafDistances { uint leaf_distances[]; };

layout(set = 0, binding = 6) readonly buffer Footprints { uvec4 footprints[]; };
layout(push_constant) uniform Push { PhotonBoxParams params; };

// Whether the boxes are around footprints or around points.
layout(constant_id = 0) const bool around_footprints = false;

// Half extents of a photon's ellipsoid, as gathering reads it.
vec3 extent(uint i) {
    uvec4 packed = footprints[i];
    vec3 normal = unpack_photon_normal(photons[i].normal);
    FootprintDuals duals;
    duals.a = unpack_dual(packed.x, packed.y);
    duals.b = unpack_dual(packed.z, packed.w);
    return footprint_extent(footprint_of_duals(duals, normal, params.flatness));
}

// The box of each leaf, and how far it is from the next one.
void main() {
    uint leaf = THREAD_INDEX;
    if (leaf >= counters[counter_leaves]) {
        return;
    }
    uint first = leaves[leaf] & leaf_first_mask;
    uint last = first + (leaves[leaf] >> leaf_first_bits);
    vec3 low = vec3(3.0e38);
    vec3 high = vec3(-3.0e38);
    for (uint i = first; i <= last; ++i) {
        vec3 p = vec3(photons[i].x, photons[i].y, photons[i].z);
        // A little more, for what rounding and packing left out.
        vec3 half_size = around_footprints ? extent(i) * 1.001 : vec3(0.0);
        low = min(low, p - half_size);
        high = max(high, p + half_size);
    }
    boxes[leaf] = BoxRecord(low.x, low.y, low.z, 0.0, high.x, high.y, high.z, 0.0);
    leaf_distances[leaf] = distances[last];
}
