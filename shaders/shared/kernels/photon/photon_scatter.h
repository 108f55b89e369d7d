#include "shared/kernels/material.h"
#include "shared/kernels/scene.h"

// Whether some material of the scene has any of these lobes.
FN bool has(uint lobes) { return (material_features & lobes) != 0u; }

// How the shading normal changes along one of a photon's differentials.
FN vec3 normal_change(HitRecord hit, Surface surface, vec3 offset) {
    if (!smooth_normals) {
        return vec3(real(0.0));
    }
    uvec4 t = triangles[hit.triangle];
    return shading_normal_change(vec3(positions[t.x]), vec3(positions[t.y]), vec3(positions[t.z]),
                                 vec3(normals[t.x]), vec3(normals[t.y]), vec3(normals[t.z]),
                                 vec2(hit.u, hit.v), surface.shading_normal, offset);
}

// The differential, transferred to the hit, after scattering from direction `incoming` to
// `outgoing`.
FN void scatter_differential(INOUT(PhotonDifferential) d, HitRecord hit, Surface surface,
                             Frame frame, BsdfSample s, real survival, vec3 incoming,
                             vec3 outgoing) {
    roulette_differential(d, s.probability * survival);
    real emitted = real(1.0) / batch.inverse_total;
    if (s.lobe == LOBE_DIFFUSE) {
        d = reemitted_differential(d, frame, outgoing, emitted, reemission);
    } else if (has(LOBE_GLOSSY | LOBE_MIRROR | LOBE_TRANSMIT) && s.lobe != LOBE_PASS) {
        vec3 n = surface.shading_normal;
        vec3 dn_du = normal_change(hit, surface, d.dp_du);
        vec3 dn_dv = normal_change(hit, surface, d.dp_dv);
        if (has(LOBE_GLOSSY) && s.lobe == LOBE_GLOSSY) {
            // The pdf is of all lobes together.
            gloss_differential(d, incoming, outgoing, n, dn_du, dn_dv, emitted,
                               s.pdf / s.probability);
        } else if (has(LOBE_MIRROR) && s.lobe == LOBE_MIRROR) {
            reflect_differential(d, incoming, n, dn_du, dn_dv);
        } else if (has(LOBE_TRANSMIT)) {
            refract_differential(d, incoming, n, dn_du, dn_dv, inversesqrt(s.eta_scale));
        }
    }
}

FN uvec4 units_of(vec3 flux) {
    return uvec4(flux_units(flux.x, batch.flux_unit), flux_units(flux.y, batch.flux_unit),
                 flux_units(flux.z, batch.flux_unit), 0u);
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_active]) {
        return;
    }
    uint slot = active_slots[i];
    PhotonPathRecord path = paths[slot];
    HitRecord hit = hits[slot];
    vec3 direction = vec3(rays[slot].direction_x, rays[slot].direction_y, rays[slot].direction_z);
    vec3 flux = vec3(path.flux_r, path.flux_g, path.flux_b);
    uint depth = path.state & photon_depth_mask;
    alive[i] = 0u;

    // Every photon has a slot for what it may leave behind, in an order that does not depend on
    // scheduling.
    bool stores = depth > 0u && depth <= batch.bounces;
    uint store = counters[counter_stored_slots] + i;
    if (stores && store >= batch.capacity) {
        atomicAdd(counters[counter_overflow], 1u);
        stores = false;
    }
    if (stores) {
        photons[store].normal = no_photon;
    }

    if (hit.triangle == no_triangle) {
        ledgers[slot].escaped += units_of(flux);
        return;
    }
    Surface surface = load_surface(hit, direction);
    MaterialRecord m = load_material(triangles[hit.triangle].w);
    Frame frame = make_frame(surface.shading_normal);
    vec3 wo = to_local(frame, -direction);
    // A photon lands in proportion to the cosine with the geometric normal; BSDFs weigh by that
    // with the shading normal (Veach 1997, §5.3).
    real geometric_in = -dot(direction, surface.geometric_normal);
    real arriving = geometric_in > real(0.0) ? wo.z / geometric_in : real(1.0);

    uint followed = followed_paths ? followed_lobes(m, scene[0].follow_roughness) : 0u;
    uint estimated = bsdf_lobes(m) & ~followed;
    PhotonDifferential d;
    if (footprints) {
        d = load_differential(differentials[slot]);
        transfer_differential(d, direction, hit.t, surface.geometric_normal);
    }
    if (stores && estimated != 0u) {
        bool caustic = followed_paths && (path.state & photon_followed) != 0u;
        photons[store] = PhotonRecord(surface.position.x, surface.position.y, surface.position.z,
                                      pack_photon_normal(surface.geometric_normal, caustic),
                                      flux.x * arriving, flux.y * arriving, flux.z * arriving,
                                      pack_photon_direction(-direction, depth));
        if (footprints) {
            offsets[store] = uvec4(pack_dual(d.dp_du), pack_dual(d.dp_dv));
        }
    }
    if (depth >= batch.bounces) {
        ledgers[slot].cut += units_of(flux);
        return;
    }

    vec4 u = photon_random4(batch.seed, batch.first + slot, 2u + depth, quasi_random);
    if (depth == 0u) {
        vec4 with_emission =
            photon_random4(batch.seed, batch.first + slot, 0u, quasi_random); // see photon_emit.h
        u.y = with_emission.z;
        u.z = with_emission.w;
    }
    BsdfSample s;
    vec3 scattered = vec3(real(0.0));
    vec3 outgoing = direction;
    bool scatters = bsdf_sample(m, wo, surface.front, followed | estimated, u, s);
    if (has(LOBE_PASS) && scatters && s.lobe == LOBE_PASS) {
        scattered = flux * s.weight;
    } else if (scatters) {
        vec3 wi = to_world(frame, s.wi);
        real geometric_out = dot(wi, surface.geometric_normal);
        if ((s.wi.z > real(0.0)) == (geometric_out > real(0.0)) && s.wi.z != real(0.0)) {
            scattered = flux * s.weight * (arriving * geometric_out / s.wi.z);
            outgoing = wi;
        }
    }
    // Roulette keeps the flux of what goes on about equal.
    real survival =
        min(max_component(scattered) / max_component(flux), depth < 64u ? real(1.0) : real(0.95));
    if (!(max_component(flux) > real(0.0)) || !(u.w < survival)) {
        ledgers[slot].absorbed += units_of(flux);
        return;
    }
    scattered /= survival;
    // What roulette adds to one photon it takes from another: absorption is a difference, and can
    // be negative.
    ledgers[slot].absorbed += units_of(flux) - units_of(scattered);
    if (footprints) {
        scatter_differential(d, hit, surface, frame, s, survival, direction, outgoing);
        differentials[slot] = differential_record(d);
    }
    vec3 origin =
        offset_ray_origin(surface.position, surface.error, surface.geometric_normal, outgoing);
    rays[slot] =
        RayRecord(origin.x, origin.y, origin.z, far_away, outgoing.x, outgoing.y, outgoing.z, 0u);
    bool stays_followed = (path.state & photon_followed) != 0u && (s.lobe & followed) != 0u;
    paths[slot] = PhotonPathRecord(scattered.x, scattered.y, scattered.z,
                                   (depth + 1u) | (stays_followed ? photon_followed : 0u));
    alive[i] = 1u;
}
