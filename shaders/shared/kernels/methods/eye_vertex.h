#include "shared/kernels/layers.h"
#include "shared/kernels/material.h"
#include "shared/kernels/scene.h"

FN bool has_light(uint kind) { return (light_kinds & (1u << kind)) != 0u; }

FN RayRecord no_ray() {
    return RayRecord(real(0.0), real(0.0), real(0.0), -real(1.0), real(0.0), real(0.0), real(1.0),
                     0u);
}

FN real power_heuristic(real a, real b) {
    // Quotients first: squares of densities overflow.
    real r = b / a;
    return real(1.0) / (real(1.0) + r * r);
}

FN RayRecord make_ray(Surface surface, vec3 direction, real t_max) {
    vec3 o =
        offset_ray_origin(surface.position, surface.error, surface.geometric_normal, direction);
    return RayRecord(o.x, o.y, o.z, t_max, direction.x, direction.y, direction.z, 0u);
}

// Whether the path ends where estimated lobes scatter it, but for a ray that seeks emission.
FN bool ends_at_estimated(uint state) {
    return photon_map && (!final_gather || (state & path_estimated) != 0u);
}

// Light that photons bring is not counted twice.
FN void add_emission(uint slot, PathRecord path, vec3 radiance) {
    uint layer = layer_of_emission(path.state);
    if (!final_gather || layer != layer_caustic) {
        add_to_layer(slot, layer, radiance);
    }
}

// onward: those of the estimated lobes that the path is scattered by as well.
FN void sample_light(uint slot, PathRecord path, vec3 throughput, Surface surface, Frame frame,
                     MaterialRecord m, vec3 wo, uint estimated, uint onward, uint followed,
                     real estimated_probability) {
    bool ends = ends_at_estimated(path.state);
    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, path.vertices * 2u + 1u);
    real choice_probability;
    LightRecord light = lights[choose_light(u.x, choice_probability)];
    LightSample s;
    vec3 o = offset_ray_origin(surface.position, surface.error, surface.geometric_normal,
                               surface.geometric_normal);
    if (!light_sample(light, light_kinds, o, vec2(u.y, u.z), s)) {
        return;
    }
    vec3 wi = to_local(frame, s.wi);
    bool sky_by_cosine = ends && is_light(light, light_kinds, light_sky);
    if (sky_by_cosine) {
        // Nothing else finds the sky for diffuse lobes here: not evenly over the sphere, half of
        // which is below.
        wi = sample_cosine_hemisphere(vec2(u.y, u.z));
        s.wi = to_world(frame, wi);
        s.radiance = light_color(light) * (PI / max(wi.z, real(1e-6)));
    }
    if (!(dot(s.wi, surface.geometric_normal) > real(0.0))) {
        return;
    }
    vec3 arriving = throughput * s.radiance * (wi.z / choice_probability);
    real weight = real(1.0); // for the lobes of `onward`; the others have nothing but this sample
    if (!s.delta && onward != 0u) {
        real density = choice_probability * s.pdf;
        weight =
            sky_by_cosine
                ? real(0.0)
                : power_heuristic(density, estimated_probability * bsdf_pdf(m, wo, wi, onward));
    }
    vec3 e = arriving * weight * bsdf_eval(m, wo, wi, onward);
    if (onward != estimated) {
        e += arriving * bsdf_eval(m, wo, wi, estimated & ~onward);
    }
    bool behind_estimated = (path.state & path_estimated) != 0u;
    bool left_to_photons = final_gather && behind_estimated;
    vec3 f = s.delta && followed != 0u && !left_to_photons
                 ? arriving * bsdf_eval(m, wo, wi, followed)
                 : vec3(real(0.0));
    if (!(max_component(e) + max_component(f) > real(0.0))) {
        return;
    }
    uint followed_layer = !behind_estimated                    ? layer_direct
                          : (path.state & path_followed) != 0u ? layer_caustic
                                                               : layer_indirect;
    shadow_rays[slot] = RayRecord(o.x, o.y, o.z, s.distance, s.wi.x, s.wi.y, s.wi.z, 0u);
    shadows[slot] = ShadowRecord(e.x, e.y, e.z, behind_estimated ? layer_indirect : layer_direct,
                                 f.x, f.y, f.z, followed_layer);
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    uint slot = active_slots[i];
    PathRecord path = paths[slot];
    HitRecord hit = hits[slot];
    vec3 direction = vec3(rays[slot].direction_x, rays[slot].direction_y, rays[slot].direction_z);
    vec3 throughput = vec3(path.throughput_r, path.throughput_g, path.throughput_b);
    alive[i] = 0u;
    if (direct_light) {
        shadow_rays[slot] = no_ray();
    }
    if (photon_map) {
        asks[i] = 0u;
    }
    bool seeks_emission = final_gather && (path.state & path_seeks_emission) != 0u;

    if (hit.triangle == no_triangle) {
        vec3 sky = vec3(scene[0].sky_r, scene[0].sky_g, scene[0].sky_b);
        if (has_light(light_sky) && max_component(sky) > real(0.0)) {
            bool found_twice = path.pdf > real(0.0) && !seeks_emission;
            real weight =
                found_twice
                    ? power_heuristic(path.pdf, scene[0].sky_probability * real(0.25) * INV_PI)
                    : real(1.0);
            add_emission(slot, path, throughput * sky * weight);
        }
        return;
    }

    Surface surface = load_surface(hit, direction);
    MaterialRecord m = load_material(triangles[hit.triangle].w);
    vec3 emission = vec3(m.emission_r, m.emission_g, m.emission_b);
    if (has_light(light_triangle) && max_component(emission) > real(0.0) &&
        (surface.front || m.double_sided != 0u)) {
        real weight = real(1.0);
        if (path.pdf > real(0.0)) {
            real cosine = max(-dot(direction, surface.geometric_normal), real(1.0e-12));
            real sides = m.double_sided != 0u ? real(2.0) : real(1.0);
            weight = power_heuristic(
                path.pdf, emitter_density(emission, sides, scene[0].light_weight, hit.t, cosine));
        }
        add_emission(slot, path, throughput * emission * weight);
    }
    if (seeks_emission ||
        ((path.state & path_estimated) != 0u && (path.state & path_depth_mask) >= batch.bounces)) {
        return;
    }
    // From here on the state's depth is that of this vertex: scatterings between the first
    // estimated vertex and it.
    Frame frame = make_frame(surface.shading_normal);
    vec3 wo = to_local(frame, -direction);
    uint followed = followed_paths ? followed_lobes(m, scene[0].follow_roughness) : 0u;
    uint estimated = bsdf_lobes(m) & ~followed;
    real followed_albedo =
        followed != 0u ? max_component(bsdf_albedo(m, wo, surface.front, followed)) : real(0.0);
    // The map answers for what else lies behind the last estimated vertex; but shadow rays alone
    // would make bright dots of lights that a glossy lobe reflects there, so one more ray looks for
    // them.
    bool ends = ends_at_estimated(path.state);
    uint onward = !ends ? estimated : final_gather ? estimated & LOBE_GLOSSY : 0u;
    real estimated_albedo =
        onward != 0u ? max_component(bsdf_albedo(m, wo, surface.front, onward)) : real(0.0);
    real albedo = followed_albedo + estimated_albedo;
    real estimated_probability = albedo > real(0.0) ? estimated_albedo / albedo : real(0.0);

    if (direct_light && scene[0].light_count > 0u &&
        ((estimated | followed) & (LOBE_DIFFUSE | LOBE_GLOSSY)) != 0u) {
        sample_light(slot, path, throughput, surface, frame, m, wo, estimated, onward, followed,
                     estimated_probability);
    }
    uint asks_for = asks_map;
    uint flags = surface.front ? query_front : 0u;
    uint scatterings = batch.bounces; // of photons at most
    if (final_gather && (path.state & path_estimated) != 0u) {
        flags |= query_gathers;
        scatterings -= (path.state & path_depth_mask) + 1u; // this one among them
    } else if (final_gather) {
        asks_for = asks_caustics;
        flags |= query_caustics;
    }
    if (photon_map && estimated != 0u && scatterings > 0u &&
        (asks_for == asks_map || followed_paths)) {
        // If answers are shared, all ask; else every few samples, which count for all.
        bool shares = batch.shares_queries != 0u;
        bool white = shares && is_lambertian(m);
        if (shares || (path.sample_index - batch.first_sample) % batch.query_step == 0u) {
            vec3 counts_by = throughput * (white ? bsdf_albedo(m, wo, surface.front, LOBE_DIFFUSE)
                                           : shares ? vec3(real(1.0))
                                                    : vec3(batch.query_weight));
            flags |= min(scatterings, most_scatterings_known) << query_scatterings_shift;
            if (white) {
                flags |= query_white;
            } else if (shares) {
                real all = max_component(bsdf_albedo(m, wo, surface.front, estimated));
                real glossy =
                    max_component(bsdf_albedo(m, wo, surface.front, estimated & LOBE_GLOSSY));
                real share = clamp(glossy / max(all, real(1e-9)), real(0.0), real(1.0));
                flags |= direction_steps(max(ggx_alpha(m), SMALLEST_ALPHA), share)
                         << query_steps_shift;
            }
            asks[i] = asks_for;
            queries[slot] =
                QueryRecord(surface.position.x, surface.position.y, surface.position.z,
                            triangles[hit.triangle].w, counts_by.x, counts_by.y, counts_by.z,
                            pack_unit(-direction), pack_unit(surface.geometric_normal),
                            pack_unit(surface.shading_normal), estimated, flags);
        }
    }
    if ((followed | onward) == 0u || !(albedo > real(0.0))) {
        return;
    }

    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, path.vertices * 2u + 2u);
    bool takes_estimated = u.w < estimated_probability;
    BsdfSample s;
    uint lobes = takes_estimated ? onward : followed;
    if (!bsdf_sample(m, wo, surface.front, lobes, u, s)) {
        return;
    }
    vec3 wi = may_have(m, LOBE_PASS) && s.lobe == LOBE_PASS ? direction : to_world(frame, s.wi);
    // The sampled side and the geometric side must be the same, or light would pass through the
    // surface.
    if ((s.wi.z > real(0.0)) != (dot(wi, surface.geometric_normal) > real(0.0))) {
        return;
    }
    real probability = takes_estimated ? estimated_probability : real(1.0) - estimated_probability;
    throughput *= s.weight * (s.eta_scale / probability);
    path.vertices += 1u;
    if (path.vertices >= 3u) {
        real survival = min(max_component(throughput), real(0.95));
        // What is left of the number that chose between the lobes is uniform again.
        real left =
            takes_estimated ? u.w / probability : (u.w - estimated_probability) / probability;
        if (!(left < survival)) {
            return;
        }
        throughput /= survival;
    }
    if (!(max_component(throughput) > real(0.0))) {
        return;
    }
    rays[slot] = make_ray(surface, wi, far_away);
    path.throughput_r = throughput.x;
    path.throughput_g = throughput.y;
    path.throughput_b = throughput.z;
    path.pdf = takes_estimated ? estimated_probability * s.pdf : real(0.0);
    path.state = state_after(path.state, !takes_estimated);
    if (ends && takes_estimated) {
        path.state |= path_seeks_emission;
    }
    paths[slot] = path;
    alive[i] = 1u;
}
