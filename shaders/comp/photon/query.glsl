// What all kinds of density estimation at the eye's queries have in common: reading a query, what its surface scatters of
// a photon's flux, and writing the estimate.
#include "photon/map_walk.glsl"
#include "shared/bsdf.h"
#include "shared/query_record.h"

layout(set = 0, binding = 3) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 4) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 5) readonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 6) readonly buffer Materials { MaterialRecord materials[]; };
layout(set = 0, binding = 8) buffer Unfinished { uint unfinished[]; };
layout(set = 0, binding = 9) writeonly buffer Estimates { EstimateRecord estimates[]; };
layout(push_constant) uniform Push { PhotonGatherParams params; };

// Whether any estimated lobe of the scene is not Lambertian.
layout(constant_id = 0) const bool glossy = true;
// Whether some surface lets light pass (alpha below 1).
layout(constant_id = 2) const bool blended = true;
// Whether some surface is modified Phong.
layout(constant_id = 3) const bool phong = true;
// Whether queries are those of a final gather (query_record.h).
layout(constant_id = 4) const bool final_gather = false;

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

struct Query {
    uint slot;
    vec3 p;
    vec3 normal;            // geometric, towards the eye
    bool front;             // the surface is seen from its front
    uint own_normal;        // packed as photons' are
    uint front_normal;      // that of the surface's front, as area samples have it
    MaterialRecord material;
    uint lobes;
    uint most_scatterings;  // of a photon that counts (final_gather)
    bool lambertian;
    vec3 reflectance;       // if lambertian, over pi
    Frame frame;            // of the shading normal
    vec3 wo;
    Sum indirect, caustic;
    float coverage;         // sum of the weighted areas
    uint node;              // to go on with
};

// The query of a slot, before its walk.
Query make_query(uint slot) {
    Query q;
    q.slot = slot;
    QueryRecord record = queries[slot];
    q.indirect = Sum(vec3(0.0), vec3(0.0));
    q.caustic = Sum(vec3(0.0), vec3(0.0));
    q.coverage = 0.0;
    q.node = first_node(params.part);
    q.material = materials[record.material];
    q.material.coverage = blended ? q.material.coverage : 1.0;
    q.material.exponent = phong ? q.material.exponent : -1.0;
    q.lobes = record.lobes;
    q.most_scatterings = (record.flags >> query_scatterings_shift) & query_scatterings_mask;
    bool white = (record.flags & query_white) != 0u;
    q.lambertian = !glossy || white || is_lambertian(q.material);
    q.p = vec3(record.x, record.y, record.z);
    q.normal = unpack_unit(record.geometric_normal);
    q.front = (record.flags & query_front) != 0u;
    q.own_normal = pack_photon_normal(q.normal, false);
    q.front_normal = q.front ? q.own_normal : pack_photon_normal(-q.normal, false);
    q.frame = make_frame(unpack_unit(record.shading_normal));
    q.wo = to_local(q.frame, unpack_unit(record.direction));
    q.reflectance = white          ? vec3(INV_PI)
                    : q.lambertian ? bsdf_eval(q.material, q.wo, vec3(0.0, 0.0, 1.0), q.lobes)
                                   : vec3(0.0);
    return q;
}

// Whether a photon's or an area sample's packed normal is that of the query's surface, on its side.
bool on_same_side(Query q, uint packed) {
    bool is_area = (packed & area_sample_bit) != 0u;
    // On flat surfaces the packed normals are the same, and nothing need be unpacked.
    if ((packed & photon_normal_mask) == (is_area ? q.front_normal : q.own_normal)) {
        return true;
    }
    float cosine = dot3(unpack_photon_normal(packed), q.normal);
    return (is_area && !q.front ? -cosine : cosine) >= same_surface_cosine;
}

// Of a photon's flux and direction, what the surface scatters towards the eye.
vec3 scattered(Query q, uvec4 carried) {
    if (final_gather && photon_scatterings(carried.w) > q.most_scatterings) {
        return vec3(0.0);
    }
    vec3 flux = uintBitsToFloat(carried.xyz);
    if (q.lambertian) {
        return flux * q.reflectance;
    }
    vec3 wi = to_local(q.frame, unpack_unit(carried.w));
    return flux * (wi.z > 0.0 ? bsdf_eval(q.material, q.wo, wi, q.lobes) : vec3(0.0));
}

void store_estimate(Query q, vec3 indirect, vec3 caustic) {
    estimates[q.slot] = EstimateRecord(indirect.x, indirect.y, indirect.z, 0.0, caustic.x, caustic.y, caustic.z, 0.0);
}
