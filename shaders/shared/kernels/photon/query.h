// Shared by all estimators: reading a query, and the flux of a photon that the query's surface
// scatters towards the eye.

#include "shared/kernels/photon/same_surface.h"
#include "shared/kernels/photon/uneven.h"

// A compensated sum, in which a million photons at one point add up.
struct Sum {
    vec3 value, compensation;
};

FN void add(INOUT(Sum) sum, vec3 term) { add_compensated(sum.value, sum.compensation, term); }

struct Query {
    uint slot;
    vec3 p;
    vec3 normal;           // geometric, towards the eye
    bool front;            // the eye sees the front of the surface
    uint own_normal;       // packed as photons' normals are
    uint front_normal;     // normal of the surface's front, as area samples have it
    uint most_scatterings; // of a photon that counts; only with limits_scatterings
    bool lambertian;
    vec3 reflectance; // of a Lambertian surface [1/sr]; the next four are for all others
    ReflectionParameters bsdf;
    uint lobes;
    Frame frame; // of the shading normal
    vec3 wo;
    real rounding; // of a height over the query's plane, by the positions' single precision
    Sum indirect, caustic;
    real coverage; // sum of the weighted areas
    Moments moments;
    uint node; // at which a walk through the map's tree continues
};

// The query of a slot, without any photon yet.
FN Query make_query(uint slot) {
    Query q;
    q.slot = slot;
    QueryRecord record = queries[slot];
    q.indirect = Sum(vec3(real(0.0)), vec3(real(0.0)));
    q.caustic = Sum(vec3(real(0.0)), vec3(real(0.0)));
    q.coverage = real(0.0);
    q.moments = no_moments();
    q.node = 0u;
    q.lobes = record.flags >> query_lobes_shift;
    q.most_scatterings = (record.flags >> query_scatterings_shift) & query_scatterings_mask;
    q.lambertian = !glossy || (record.flags & query_lambertian) != 0u;
    q.reflectance = vec3(record.reflectance_r, record.reflectance_g, record.reflectance_b);
    q.p = vec3(record.x, record.y, record.z);
    q.rounding = max_component(abs(q.p)) * position_rounding;
    q.normal = unpack_unit(record.geometric_normal);
    q.front = (record.flags & query_front) != 0u;
    q.own_normal = pack_photon_normal(q.normal, false);
    q.front_normal = q.front ? q.own_normal : pack_photon_normal(-q.normal, false);
    if (glossy) { // Lambertian surfaces leave no record and do not use what they read here.
        QueryBsdfRecord packed = query_bsdfs[slot];
        q.bsdf = reflection_parameters(packed);
        // Set here, not passed as an argument: Mesa 22 does not see a specialization constant
        // through an argument and would keep the code of absent lobes in the loop.
        q.bsdf.absent = ~material_features;
        q.frame = make_frame(unpack_unit(packed.shading_normal));
        q.wo = to_local(q.frame, unpack_unit(packed.direction));
    }
    return q;
}

// Whether a photon or an area sample of this packed normal, at the end of a chord from the query,
// lies on the query's surface, on the query's side of it.
FN bool on_same_surface(IN(Query) q, uint packed, vec3 chord) {
    bool is_area = (packed & area_sample_bit) != 0u;
    return are_on_one_surface(q.normal, is_area ? q.front_normal : q.own_normal, packed,
                              is_area && !q.front, q.rounding, chord);
}

// The part of an area sample on the query's side. carried: the sample's second four words.
FN real open_area(IN(Query) q, uvec4 carried) {
    return bits_float(q.front ? carried.x : carried.y);
}

// What the surface scatters towards the eye from a photon's flux.
struct Scattered {
    vec3 radiance;
    // Its share of the flux, times explained_weight, up to a factor common to all photons of the
    // query.
    real weight;
};

// The weight of a photon in the effective number of photons. It is the geometric mean of flux and
// rarity, which counts three times, so that a photon counts as many where it is bright because
// others were aimed. One that is only bright may be from another room, and one that is only rare
// may be from a dim light.
FN real explained_weight(vec3 flux, uint packed) {
    real rarity = photon_rarity(packed);
    return sqrt(rarity * sqrt(rarity) * sqrt(sum_of_channels(flux)));
}

// carried: the photon's second four words.
FN Scattered scattered(IN(Query) q, uvec4 carried) {
    Scattered s;
    s.radiance = vec3(real(0.0));
    s.weight = real(0.0);
    if (limits_scatterings && photon_scatterings(carried.w) > q.most_scatterings) {
        return s;
    }
    vec3 flux = bits_float(uvec3(carried));
    if (!glossy || q.lambertian) {
        s.radiance = flux * q.reflectance;
        s.weight = explained_weight(flux, carried.w);
        return s;
    }
    vec3 wi = to_local(q.frame, unpack_unit(carried.w));
    if (wi.z > real(0.0)) {
        vec3 share = bsdf_eval(q.bsdf, q.wo, wi, q.lobes);
        s.radiance = flux * share;
        s.weight = sum_of_channels(share) * explained_weight(flux, carried.w);
    }
    return s;
}

// place: a photon's first four words.
FN bool is_caustic(uvec4 place) { return caustics && photon_is_caustic(place.w); }
