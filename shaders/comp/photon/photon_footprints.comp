#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/footprint.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Photons { PhotonRecord photons[]; };
layout(set = 0, binding = 1) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) writeonly buffer Footprints { uvec4 footprints[]; };
layout(set = 0, binding = 5) writeonly buffer Shares { uint shares[]; };
layout(push_constant) uniform Push { FootprintParams params; };

// Of the photon at place i of the order.
Footprint footprint_at(uint i) {
    uint slot = order[i];
    PhotonDifferential d = no_differential();
    d.dp_du = unpack_dual(offsets[slot].x, offsets[slot].y);
    d.dp_dv = unpack_dual(offsets[slot].z, offsets[slot].w);
    uint normal = photons[slot].normal;
    return make_footprint(d, unpack_photon_normal(normal), photon_is_caustic(normal), params.scale);
}

// Where photons spread as far as their neighbours do, part of them falls off the surface's edge; so the same share must
// be missing of the area that the samples near there add up to.
float radius_nearby(uint i) {
    uint stored = counters[counter_stored];
    uint first = i - min(i, area_neighbours);
    uint last = min(i + area_neighbours, stored - 1u);
    float sum = 0.0;
    float count = 0.0;
    for (uint j = first; j <= last; ++j) {
        uint normal = photons[order[j]].normal;
        if ((normal & (area_sample_bit | photon_caustic_bit)) == 0u) {
            Footprint f = footprint_at(j);
            sum += parallelogram_side(f.u, f.v);
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : 0.0;
}

// Footprints in the order of the map, as dual axes, and their areas in shares of the scene's.
void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_stored]) {
        return;
    }
    uint packed = photons[order[i]].normal;
    vec3 normal = unpack_photon_normal(packed);
    Footprint f;
    float share = 0.0;
    if ((packed & area_sample_bit) != 0u) {
        Frame frame = make_frame(normal);
        float radius = max(radius_nearby(i), params.scale.radius_min);
        f.u = frame.x * radius;
        f.v = frame.y * radius;
        f.w = normal * radius;
    } else {
        f = footprint_at(i);
        share = footprint_area(f) * params.inverse_surface_area * float(area_shares);
    }
    FootprintDuals duals = footprint_duals(f, normal);
    footprints[i] = uvec4(pack_dual(duals.a), pack_dual(duals.b));
    shares[i] = uint(min(share, float(area_shares)) + 0.5);
}
