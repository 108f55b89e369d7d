#include "shared/kernels/scene.h"
#include "shared/kernels/textures.h"

#include "shared/kernels/dispersion.h"
#include "shared/kernels/medium.h"
#include "shared/kernels/normals.h"

#include "shared/kernels/anisotropy.h"
#include "shared/kernels/coat.h"

// Whether any material of the scene has one of these lobes.
FN bool has(uint lobes) { return may_have(~material_features, lobes); }

// Change of the shading normal along one of a photon's differentials.
FN vec3 normal_change(HitRecord hit, Surface surface, vec3 offset) {
    if (!smooth_normals) {
        return vec3(real(0.0));
    }
    return shading_normal_change(load_triangle(hit.triangle), vec2(hit.u, hit.v),
                                 surface.shading_normal, offset);
}

// A photon at its hit on a surface.
struct Arrival {
    HitRecord hit;
    Surface surface;
    Frame frame;    // about the shading normal
    vec3 direction; // in which it travels
    vec3 wo;        // where it came from, in the frame
    vec3 flux;
    real shading; // cosine with the shading normal over that with the geometric one
    uint depth;   // number of scatterings so far
    real carried; // largest component of the flux before a solid on its way absorbed some
    uint solids;  // in which it came (kernels/medium.h)
    bool hidden;  // inside a solid of higher rank
};

FN Arrival arrive(HitRecord hit, vec3 direction, MaterialRecord m, PhotonPathRecord path) {
    Arrival a;
    a.hit = hit;
    a.surface = load_surface(hit, direction);
    turn_normal(m.textures, hit, direction, a.surface);
    a.frame = make_frame(a.surface.shading_normal);
    a.wo = to_local(a.frame, toward_above(a.surface, -direction));
    a.direction = direction;
    a.flux = vec3(path.flux_r, path.flux_g, path.flux_b);
    // Photons arrive in proportion to the cosine with the geometric normal, but the BSDF is
    // weighted by the cosine with the shading normal (Veach 1997, §5.3).
    real cosine = -dot(direction, a.surface.geometric_normal);
    a.shading = cosine > real(0.0) ? to_local(a.frame, -direction).z / cosine : real(1.0);
    if (normal_maps && !a.surface.above_horizon && has_normal_texture(m.textures)) {
        a.shading = real(0.0); // light from below the horizon is not scattered
    }
    a.depth = path.state & photon_depth_mask;
    a.carried = max_component(a.flux);
    a.solids = 0u;
    a.hidden = false;
    return a;
}

// How a photon leaves the surface that it met.
struct Departure {
    BsdfSample sampled;
    vec3 flux; // before roulette
    vec3 direction;
    // Density of photons that leave in this direction over that without aiming at what is in view.
    real concentration;
};

// Aims some of the photons that rough reflection scatters at what is in view. lobes: as in depart;
// view: where it is seen, from outside; u: where in the cone; choice: whether to aim; both in
// [0,1). The flux of all photons in such directions is divided by their concentration (balance
// heuristic). Returns false where no light is scattered.
FN bool aim_at_view(Arrival a, MaterialRecord m, uint lobes, Cone view, vec2 u, real choice,
                    INOUT(Departure) d) {
    real share = real(scene[0].view_share);
    vec3 wo = a.wo;
    vec4 probabilities = lobe_probabilities(m, wo, lobes);
    bool aims = choice < share;
    if (aims) {
        d.sampled.wi = to_local(a.frame, sample_cone(view, u));
        vec3 f = bsdf_eval_and_pdf(reflection_parameters(m), wo, d.sampled.wi, lobes, probabilities,
                                   d.sampled.pdf);
        d.sampled.weight = f * (d.sampled.wi.z / d.sampled.pdf);
    }
    bool in_view = aims || is_in_cone(view, to_world(a.frame, d.sampled.wi));
    real rough = probabilities.x + probabilities.y;
    real aimed = in_view ? share * rough / (cone_solid_angle(view) * d.sampled.pdf) : real(0.0);
    if (!(d.sampled.pdf > real(0.0)) || !is_finite(aimed)) {
        return false;
    }
    d.concentration = real(1.0) - share + aimed;
    d.sampled.weight = d.sampled.weight / d.concentration;
    return true;
}

// The cone in which a photon that arrives here sees what is in view. Its height is 0 if photons
// are not aimed from here.
FN Cone view_from(Arrival a) { return cone_of(vec4(scene[0].view), a.surface.position); }

// Eyes below the horizon of a normal that a texture has turned see the surface as from the mirrored
// direction (toward_above). So half of the photons that leave in a direction whose mirrored one is
// above the surface go there, and all of these carry twice the flux. u: in [0,1). Returns by how
// much to multiply the flux.
FN real mirror_below(Arrival a, real u, INOUT(vec3) wi, INOUT(real) cosine) {
    vec3 n = a.surface.shading_normal;
    vec3 below = wi - n * (real(2.0) * dot3(n, wi));
    real cosine_below = dot3(below, a.surface.geometric_normal);
    if (!(cosine_below > real(0.0))) {
        return real(1.0);
    }
    if (u < real(0.5)) {
        wi = below;
        cosine = cosine_below;
    }
    return real(2.0);
}

// Leaves a surface whose normal a texture has turned. Density: of directions about the geometric
// normal for diffuse lobes, whose BSDF hardly depends on them; about the turned one, the cosine
// with the former over that with the latter would have no bounded variance. u: as of bsdf_sample.
FN void depart_turned(Arrival a, MaterialRecord m, vec4 u, real mirrored, INOUT(Departure) d) {
    vec3 wi = to_world(a.frame, d.sampled.wi);
    real cosine = dot3(wi, a.surface.geometric_normal);
    bool diffuse = d.sampled.lobe == LOBE_DIFFUSE;
    vec3 seen = d.sampled.wi;
    if (diffuse) {
        wi = to_world(make_frame(a.surface.geometric_normal),
                      sample_cosine_hemisphere(vec2(u.y, u.z)));
        seen = to_local(a.frame, toward_above(a.surface, wi));
    }
    if (diffuse || d.sampled.lobe == LOBE_GLOSSY) {
        real pdf; // of the glossy lobe alone
        vec3 f = bsdf_eval_and_pdf(reflection_parameters(m), a.wo, seen, d.sampled.lobe,
                                   vec4(real(0.0), real(1.0), real(0.0), real(0.0)), pdf);
        if (diffuse) {
            d.flux = a.flux * f * (PI * a.shading / d.sampled.probability);
            d.direction = wi;
            return;
        }
        d.sampled.weight =
            pdf > real(0.0) ? f * (seen.z / (pdf * d.sampled.probability)) : vec3(real(0.0));
    }
    if ((d.sampled.wi.z > real(0.0)) == (cosine > real(0.0)) && d.sampled.wi.z != real(0.0)) {
        real factor =
            d.sampled.wi.z > real(0.0) ? mirror_below(a, mirrored, wi, cosine) : real(1.0);
        d.flux = a.flux * d.sampled.weight * (factor * a.shading * cosine / d.sampled.wi.z);
        d.direction = wi;
    }
}

// Samples how the photon leaves the surface. followed, estimated: the lobes to sample from. u,
// choice, mirrored: in [0,1).
FN Departure depart(Arrival a, MaterialRecord m, uint followed, uint estimated, Cone view, vec4 u,
                    real choice, real mirrored) {
    Departure d;
    uint lobes = followed | estimated;
    d.concentration = real(1.0);
    d.flux = vec3(real(0.0));
    d.direction = a.direction;
    vec3 wo = a.wo;
    bool scatters = bsdf_sample(m, wo, a.surface.front, lobes, u, d.sampled);
    if (has(MATERIAL_COAT_NORMAL) && scatters && d.sampled.lobe == LOBE_COAT) {
        d.sampled.weight = d.sampled.weight * (coat_cosines(m, wo) / coat_cosines(m, d.sampled.wi));
    }
    if (aims_at_view && view.height > real(0.0) && !has_normal_texture(m.textures) &&
        (lobes & LOBE_GLOSSY & followed) == 0u &&
        (d.sampled.lobe & (LOBE_DIFFUSE | LOBE_GLOSSY)) != 0u) {
        scatters = aim_at_view(a, m, lobes, view, vec2(u.y, u.z), choice, d);
    }
    if (scatters && has_normal_texture(m.textures)) {
        depart_turned(a, m, u, mirrored, d);
    } else if (scatters) {
        vec3 wi = to_world(a.frame, d.sampled.wi);
        real cosine = dot(wi, a.surface.geometric_normal);
        if ((d.sampled.wi.z > real(0.0)) == (cosine > real(0.0)) && d.sampled.wi.z != real(0.0)) {
            d.flux = a.flux * d.sampled.weight * (a.shading * cosine / d.sampled.wi.z);
            d.direction = wi;
        }
    }
    return d;
}

// Probability with which Russian roulette lets a photon continue; it keeps the flux of photons
// roughly equal, but for the flux of aimed ones, which are the more for it. aimed: how many photons
// of little flux were aimed in the place of one, as a logarithm; it is 0 unless the photon leaves
// what it was aimed for.
FN real survival_probability(Arrival a, Departure d, uint aimed) {
    real kept = max_component(d.flux) / a.carried;
    if (aims_at_view) {
        kept *= max(d.concentration, real(1.0));
    }
    return min(kept, a.depth < 64u ? real(1.0) : real(0.95)) / real(1u << aimed);
}

// Updates the photon's differential, transferred to the hit, for the scattering.
FN void scatter_differential(INOUT(PhotonDifferential) d, Arrival a, IN(MaterialRecord) m,
                             Departure out_of, real survival) {
    BsdfSample s = out_of.sampled;
    roulette_differential(d, s.probability * survival * out_of.concentration);
    real emitted = out_of.concentration / batch.inverse_spread;
    if (s.lobe == LOBE_DIFFUSE) {
        d = reemitted_differential(d, a.frame, out_of.direction, emitted, reemission);
    } else if (has(LOBE_GLOSSY | LOBES_SPREAD | LOBE_MIRROR | LOBE_TRANSMIT)) {
        NormalDifferential normal;
        normal.n = s.lobe == LOBE_COAT && has_coat_normal(m.absent, coat_normal(m))
                       ? to_world(a.frame, coat_normal(m))
                       : a.surface.shading_normal;
        normal.dn_du = normal_change(a.hit, a.surface, d.dp_du);
        normal.dn_dv = normal_change(a.hit, a.surface, d.dp_dv);
        if (has(LOBE_GLOSSY | LOBE_COAT) && (s.lobe == LOBE_GLOSSY || s.lobe == LOBE_COAT)) {
            // The pdf includes the choice of the lobe.
            gloss_differential(d, a.direction, out_of.direction, normal, emitted,
                               s.pdf / s.probability);
        } else if (has(LOBE_CLEAR) && s.lobe == LOBE_CLEAR) {
            rough_clear_differential(d, a.direction, out_of.direction, normal,
                                     inversesqrt(s.eta_scale), emitted, s.pdf / s.probability);
        } else if (has(LOBE_MIRROR) && s.lobe == LOBE_MIRROR) {
            reflect_differential(d, a.direction, normal);
        } else if (has(LOBE_TRANSMIT)) {
            refract_differential(d, a.direction, normal, inversesqrt(s.eta_scale));
        }
    }
}

FN uvec4 units_of(vec3 flux) { return uvec4(flux_units(flux, batch.flux_unit), 0u); }

// Takes away what the solid on the photon's way absorbed.
FN void absorb(uint slot, INOUT(Arrival) a, IN(MaterialRecord) m) {
    if (!has(MATERIAL_ABSORPTION)) {
        return;
    }
    vec3 flux = a.flux;
    a.flux = flux * transmittance_to(a.solids, m, a.surface.front, a.hit.t);
    ledgers[slot].absorbed += units_of(flux) - units_of(a.flux);
}

// Whether photons of this depth are stored.
FN bool stores_at(uint depth) { return depth >= batch.least_scatterings && depth <= batch.bounces; }

// Whether a photon of this depth has a slot in this round, stored there or not.
FN bool has_slot_at(uint depth) {
    return has(MATERIAL_ALPHA) ? batch.has_slots != 0u : stores_at(depth);
}

// Adds the hit to the photon's path. Returns the index of the vertex.
FN uint add_vertex(uint slot, uint store, Arrival a) {
    bool in_slot = has_slot_at(a.depth);
    uint vertex = in_slot ? 2u * batch.paths + store : 2u * (batch.first_path + slot) + 1u;
    if (!in_slot || store < batch.capacity) {
        vec3 p = a.surface.position;
        vertices[vertex] = PathVertex(p.x, p.y, p.z, path_vertices[slot]);
    }
    return vertex;
}

// Reserves the slot `store` for the photon of an invocation, in an order that does not depend on
// scheduling. Returns whether the photon may be stored.
FN bool reserve(uint store, uint depth) {
    bool has_slot = has_slot_at(depth);
    if (has_slot && store >= batch.capacity) {
        atomicAdd(counters[counter_overflow], 1u);
        has_slot = false;
    }
    if (has_slot) {
        photons[store].normal = no_photon;
    }
    return has_slot && stores_at(depth);
}

// state: of its PhotonPathRecord.
FN void store_photon(uint store, Arrival a, bool caustic, uint state) {
    vec3 p = a.surface.position;
    uint aimed = ((state >> photon_view_shift) & photon_density_mask) +
                 ((state >> photon_outside_shift) & photon_density_mask);
    photons[store] =
        PhotonRecord(p.x, p.y, p.z, pack_photon_normal(a.surface.geometric_normal, caustic),
                     a.flux.x * a.shading, a.flux.y * a.shading, a.flux.z * a.shading,
                     pack_photon_direction(-a.direction, a.depth, min(aimed, photon_density_mask)));
}

// Whether a photon of the map comes from a surface so near that eye paths follow its light instead;
// counts those from nearby surfaces.
FN bool is_left_to_eye_paths(Arrival a) {
    if (!(a.hit.t < scene[0].near_distance)) {
        return false;
    }
    atomicAdd(counters[counter_near], 1u);
    return scene[0].follows_near != 0u;
}

// The random numbers of a photon's scattering. Those of the first one lie in one set of four with
// those of the direction of emission, see photon_emit.h.
FN vec4 scattering_random(uint slot, uint depth) {
    vec4 u = photon_random4(batch.seed, batch.first + slot, 2u + depth, numbers);
    if (depth == 0u) {
        vec4 with_emission = photon_random4(batch.seed, batch.first + slot, 0u, numbers);
        u.y = with_emission.z;
        u.z = with_emission.w;
    }
    return u;
}

// Writes the ray and the state with which a photon continues. flags: of the state.
FN void continue_path(uint slot, Arrival a, vec3 direction, vec3 flux, uint cone, uint solids,
                      uint flags) {
    vec3 origin = offset_ray_origin(a.surface.position, a.surface.error, a.surface.geometric_normal,
                                    direction);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, unbounded_in(solids), direction.x,
                           direction.y, direction.z, cone);
    paths[slot] = PhotonPathRecord(flux.x, flux.y, flux.z, (a.depth + 1u) | flags);
}

// The probability with which a photon goes straight on where the surface is absent.
FN real pass_probability(Arrival a, MaterialRecord m) {
    real passes = pass_share(m);
    if (!(passes > real(0.0))) {
        return real(0.0);
    }
    vec3 albedo = bsdf_albedo(m, a.wo, a.surface.front, bsdf_lobes(m));
    return passes / (passes + mean_component(albedo));
}

// Lets a photon go straight on. That is no scattering: it stays what it was, and so does its
// differential, which will be transferred from where its ray began. u: in [0,1).
FN void pass_surface(uint i, uint slot, Arrival a, IN(MaterialRecord) m, real probability, real u) {
    real kept = pass_share(m) / probability;
    real survival = min(kept, real(1.0));
    if (!(u < survival)) {
        ledgers[slot].absorbed += units_of(a.flux);
        return;
    }
    // Solids absorb on the whole way, once its end is known.
    vec3 flux =
        vec3(paths[slot].flux_r, paths[slot].flux_g, paths[slot].flux_b) * (kept / survival);
    ledgers[slot].absorbed += units_of(a.flux) - units_of(flux);
    paths[slot].flux_r = flux.x;
    paths[slot].flux_g = flux.y;
    paths[slot].flux_b = flux.z;
    rays[slot].t_max = goes_on_past(rays[slot].t_max, a.solids, m, a.surface.front, a.hidden);
    if (extents == extents_differentials) {
        PhotonDifferential d = load_differential(differentials[slot]);
        roulette_differential(d, probability * survival);
        differentials[slot] = differential_record(d);
    }
    alive[i] = 1u;
}

// Leaves one colour channel where the surface disperses. Returns the inverse of the probability
// with which it was chosen.
FN real disperse_photon(uint slot, INOUT(Arrival) a, MaterialRecord m, uint triangle) {
    if (!has(MATERIAL_DISPERSION)) {
        return real(1.0);
    }
    uvec4 before = units_of(a.flux);
    vec4 w = random4(batch.seed ^ 0xd15be5u, batch.first + slot, a.depth, triangle);
    real channels = disperse(m, a.flux, w.x);
    ledgers[slot].absorbed += before - units_of(a.flux);
    return channels;
}

// Stores the photon with what is kept beside it.
FN void store_with_details(uint slot, uint store, Arrival a, bool caustic, uint state,
                           IN(PhotonDifferential) d) {
    store_photon(store, a, caustic, state);
    if (extents != extents_none) {
        offsets[store] = uvec4(pack_dual(d.dp_du), pack_dual(d.dp_dv));
    }
    if ((keeps & kept_light) != 0u) {
        photon_lights[store] = path_lights[slot];
    }
}

// What a photon's scattering depends on, beside the arrival and the material.
struct Scattering {
    uint state; // of the path
    uint triangle, cone;
    real distance; // of the hit
    uint followed, estimated;
    bool only_followed; // lobes have scattered it so far
    real scattered;     // share of the photons that do not go straight on
};

// Samples the direction in which a photon goes on. Returns false if it is absorbed.
FN bool scatter_photon(uint slot, Arrival a, MaterialRecord m, IN(Scattering) how,
                       INOUT(PhotonDifferential) d) {
    vec4 u = scattering_random(slot, a.depth);
    Cone view;
    view.height = real(0.0);
    real choice = real(1.0);
    if (aims_at_view) {
        view = view_from(a);
        choice =
            photon_random4(batch.seed, batch.first + slot, dimension_of_aims + a.depth, numbers).x;
    }
    bool is_elsewhere = view.height > real(0.0);
    real mirrored = real(0.0);
    if (normal_maps) {
        mirrored =
            photon_random4(batch.seed, batch.first + slot, dimension_of_aims + a.depth, numbers).y;
    }
    Departure out_of = depart(a, m, how.followed, how.estimated, view, u, choice, mirrored);
    if (has(MATERIAL_ALPHA)) {
        out_of.flux = out_of.flux / how.scattered;
        out_of.sampled.probability *= how.scattered;
        out_of.sampled.pdf *= how.scattered;
    }
    bool stays_followed = how.only_followed && (out_of.sampled.lobe & how.followed) != 0u;
    uint for_view = (how.state >> photon_view_shift) & photon_density_mask;
    uint leaves =
        stays_followed ? 0u : (how.state >> photon_aimed_shift) + (is_elsewhere ? for_view : 0u);
    real survival = survival_probability(a, out_of, min(leaves, largest_photon_aimed));
    if (!(max_component(a.flux) > real(0.0)) || !(u.w < survival)) {
        ledgers[slot].absorbed += units_of(a.flux);
        return false;
    }
    vec3 flux = out_of.flux / survival;
    // Roulette moves flux from one photon to another, so absorption is a difference and may be
    // negative.
    ledgers[slot].absorbed += units_of(a.flux) - units_of(flux);
    if (extents == extents_differentials) {
        scatter_differential(d, a, m, out_of, survival);
        differentials[slot] = differential_record(d);
    }
    uint next_for_view = is_elsewhere ? aimed_by(out_of.concentration) : for_view;
    uint cone = how.cone;
    if (mip_maps) {
        cone = pack_cone(cone_width(cone, how.distance),
                         scattered_spread(cone_spread(cone), real(1.0) / batch.inverse_total,
                                          out_of.sampled.pdf));
    }
    continue_path(slot, a, out_of.direction, flux, cone,
                  solids_after(a.solids, m, a.surface.front, out_of.sampled.wi.z < real(0.0)),
                  stays_followed ? how.state & ~photon_depth_mask
                                 : (how.state & (photon_density_mask << photon_outside_shift)) |
                                       (next_for_view << photon_view_shift));
    return true;
}

// The differential of a photon that has flown `distance` along `direction`, at its arrival `a`;
// `channels` is what disperse_photon returned. Undefined where photons have no extents.
FN PhotonDifferential arriving_differential(uint slot, vec3 direction, real distance, Arrival a,
                                            real channels) {
    PhotonDifferential d;
    if (extents == extents_differentials) {
        d = load_differential(differentials[slot]);
        transfer_differential(d, direction, distance, a.surface.geometric_normal);
        if (has(MATERIAL_DISPERSION) && channels > real(1.0)) {
            roulette_differential(d, real(1.0) / channels);
        }
    } else if (extents == extents_splats) {
        d = splat_differential(direction, distance, a.surface.geometric_normal);
    }
    return d;
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
    uint store = counters[counter_stored_slots] + i;
    bool stores = reserve(store, path.state & photon_depth_mask);
    alive[i] = 0u;
    if (hit.triangle == no_triangle) {
        uvec4 units = units_of(vec3(path.flux_r, path.flux_g, path.flux_b));
        if (hit.u == ray_lost) {
            ledgers[slot].lost += units;
        } else {
            ledgers[slot].escaped += units;
        }
        return;
    }

    Scattering how;
    how.state = path.state;
    how.triangle = hit.triangle;
    how.distance = hit.t;
    how.cone = rays[slot].cone;
    MaterialRecord m = material_at(triangles[hit.triangle], hit, how.cone, direction);
    Arrival a = arrive(hit, direction, m, path);
    turn_anisotropy(hit, a.surface, a.frame, m);
    turn_coat(hit, a.surface, a.frame, m);
    a.solids = solids_on_way(solids_of(rays[slot].t_max), m, a.surface.front);
    absorb(slot, a, m);
    a.hidden = is_hidden(a.solids, m);
    if (a.hidden) {
        m.coverage = float32(0.0);
    }
    real channels = disperse_photon(slot, a, m, hit.triangle);
    refer_index(a.solids, m);
    how.followed = followed_paths ? followed_lobes(m, scene[0].follow_roughness) : 0u;
    how.estimated = bsdf_lobes(m) & ~how.followed;
    PhotonDifferential d = arriving_differential(slot, direction, hit.t, a, channels);
    how.only_followed = (path.state & photon_followed) != 0u;
    bool may_be_estimated = how.estimated != 0u || (m.textures & material_stores_everywhere) != 0u;
    // Seen from above the horizon of the shading normal, light from below it is not scattered.
    bool caustic = followed_paths && how.only_followed && a.depth > 0u;
    if (stores && may_be_estimated && !a.hidden && a.surface.above_horizon &&
        (caustic || !is_left_to_eye_paths(a))) {
        store_with_details(slot, store, a, caustic, path.state, d);
    }
    uint vertex = (keeps & kept_path) != 0u ? add_vertex(slot, store, a) : 0u;
    how.scattered = real(1.0);
    if (has(MATERIAL_ALPHA)) {
        // A ray meets a triangle once, so the triangle tells one pass from another.
        vec4 w = random4(batch.seed ^ 0x7a55e5u, batch.first + slot, a.depth, hit.triangle);
        real passes = pass_probability(a, m);
        if (w.x < passes) {
            pass_surface(i, slot, a, m, passes, w.y);
            return;
        }
        how.scattered = real(1.0) - passes;
    }
    if (a.depth >= batch.bounces) {
        ledgers[slot].cut += units_of(a.flux);
        return;
    }
    if (scatter_photon(slot, a, m, how, d)) {
        if ((keeps & kept_path) != 0u) {
            path_vertices[slot] = vertex;
        }
        alive[i] = 1u;
    }
}
