// Density estimation at every query that asks. Included by kernels that define TEXELS (0 or 1).
#include "photon/map_walk.glsl"
#include "shared/bsdf.h"
#include "shared/path_records.h"
#include "shared/query_record.h"

layout(set = 0, binding = 3) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 6) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 7) buffer Gathers { GatherRecord gathers[]; };
layout(set = 0, binding = 8) buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 9) buffer Layers { LayersRecord layers[]; };
layout(push_constant) uniform Push { PhotonGatherParams params; };

// Whether any estimated lobe of the scene is not Lambertian.
layout(constant_id = 0) const bool glossy = true;

#include "layers.glsl"

// Sum with compensation for rounding (Kahan), so that a million photons in one point add up.
struct Sum {
    vec3 value, compensation;
};

void add(inout Sum sum, vec3 term) {
    vec3 y = term - sum.compensation;
    vec3 t = sum.value + y;
    sum.compensation = (t - sum.value) - y;
    sum.value = t;
}

void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[params.count_index]) {
        return;
    }
    uint slot = active_slots[i];
    QueryRecord query = queries[slot];
    Sum indirect = Sum(vec3(0.0), vec3(0.0));
    Sum caustic = Sum(vec3(0.0), vec3(0.0));
    float coverage = 0.0;
    uint node = first_node();
    if (params.first == 0u) {
        GatherRecord g = gathers[slot];
        indirect.value = vec3(g.indirect_r, g.indirect_g, g.indirect_b);
        caustic.value = vec3(g.caustic_r, g.caustic_g, g.caustic_b);
        indirect.compensation =
            vec3(g.indirect_compensation_r, g.indirect_compensation_g, g.indirect_compensation_b);
        caustic.compensation = vec3(g.caustic_compensation_r, g.caustic_compensation_g, g.caustic_compensation_b);
        node = g.node;
        coverage = g.coverage;
        if (node == lbvh_end) {
            return;
        }
    }

    MaterialRecord m = materials[query.material];
    bool lambertian = !glossy || bsdf_lobes(m) == LOBE_DIFFUSE;
    vec3 p = vec3(query.x, query.y, query.z);
    vec3 normal = unpack_unit(query.geometric_normal);
    uint own_normal = pack_photon_normal(normal, false);
    uint front_normal = query.front != 0u ? own_normal : pack_photon_normal(-normal, false);
    Frame frame = make_frame(unpack_unit(query.shading_normal));
    vec3 wo = to_local(frame, unpack_unit(query.direction));
    vec3 reflectance = lambertian ? bsdf_eval(m, wo, vec3(0.0, 0.0, 1.0), query.lobes) : vec3(0.0);
    float r2 = params.radius * params.radius;
    float caustic_r2 = params.caustic_radius * params.caustic_radius;
    float inverse_r2 = 1.0 / r2;
    float inverse_caustic_r2 = 1.0 / caustic_r2;
    float half_height = params.radius * disc_half_height;

    uint steps = 0u;
    for (;;) {
        PhotonRange range = next_leaf(p, r2, params.budget, node, steps);
        if (range.end == 0u) {
            break;
        }
        vec3 indirect_leaf = vec3(0.0);
        vec3 caustic_leaf = vec3(0.0);
        float area_leaf = 0.0;
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            vec3 d = uintBitsToFloat(place.xyz) - p;
            float height = dot3(d, normal);
            float d2 = dot3(d, d) - height * height;
            if (!(d2 < r2) || abs(height) > half_height) {
                continue;
            }
            uint photon_normal = place.w;
            bool is_area = (photon_normal & area_sample_bit) != 0u;
            // On flat surfaces the packed normals are the same, and nothing need be unpacked.
            if ((photon_normal & photon_normal_mask) != (is_area ? front_normal : own_normal)) {
                vec3 n = unpack_photon_normal(photon_normal);
                float cosine = dot3(n, normal);
                if ((is_area && query.front == 0u ? -cosine : cosine) < same_surface_cosine) {
                    continue;
                }
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            if (is_area) {
                area_leaf += uintBitsToFloat(carried.x) * kernel_weight(d2 * inverse_r2);
                continue;
            }
            vec3 term = uintBitsToFloat(carried.xyz);
            if (lambertian) {
                term *= reflectance;
            } else {
                vec3 wi = to_local(frame, unpack_unit(carried.w));
                term *= wi.z > 0.0 ? bsdf_eval(m, wo, wi, query.lobes) : vec3(0.0);
            }
            if (photon_is_caustic(photon_normal)) {
                caustic_leaf += term * kernel_weight(d2 * inverse_caustic_r2);
            } else {
                indirect_leaf += term * kernel_weight(d2 * inverse_r2);
            }
        }
        // The kernel's factor is the same for all.
        add(indirect, indirect_leaf * (kernel_scale * inverse_r2));
        add(caustic, caustic_leaf * (kernel_scale * inverse_caustic_r2));
        coverage += area_leaf * (kernel_scale * inverse_r2);
    }

    if (node != lbvh_end) {
        gathers[slot] = GatherRecord(indirect.value.x, indirect.value.y, indirect.value.z, node, caustic.value.x,
                                     caustic.value.y, caustic.value.z, coverage, indirect.compensation.x,
                                     indirect.compensation.y, indirect.compensation.z, 0.0, caustic.compensation.x,
                                     caustic.compensation.y, caustic.compensation.z, 0.0);
        atomicAdd(unfinished[0], 1u);
        return;
    }
    gathers[slot].node = lbvh_end;
    // Photons fill only the part of the disc that lies on surfaces.
    float scale = params.boundary_correction != 0u ? 1.0 / max(coverage, least_coverage) : 1.0;
    // The coverage is known of the whole disc only.
    float caustic_scale = caustic_r2 < r2 ? 1.0 : scale;
    vec3 throughput = vec3(query.throughput_r, query.throughput_g, query.throughput_b);
    add_to_layer(slot, layer_indirect, throughput * scale * indirect.value);
    add_to_layer(slot, layer_caustic, throughput * caustic_scale * caustic.value);
}
