#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene.glsl"
#include "shared/follow.h"
#include "shared/lights.h"
#include "shared/photon.h"
#include "shared/query_cell.h"
#include "shared/query_record.h"
#include "shared/sampling.h"

layout(set = 0, binding = 7) readonly buffer Hits { HitRecord hits[]; };
layout(set = 0, binding = 8) readonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 9) readonly buffer Counts { uint counts[]; };
layout(set = 0, binding = 10) buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 11) buffer Paths { PathRecord paths[]; };
layout(set = 0, binding = 12) buffer Layers { LayersRecord layers[]; };
layout(set = 0, binding = 13) writeonly buffer ShadowRays { RayRecord shadow_rays[]; };
layout(set = 0, binding = 14) writeonly buffer Shadows { ShadowRecord shadows[]; };
layout(set = 0, binding = 15) writeonly buffer Queries { QueryRecord queries[]; };
layout(set = 0, binding = 16) writeonly buffer Alive { uint alive[]; };
layout(set = 0, binding = 17) writeonly buffer Asks { uint asks[]; };
layout(push_constant) uniform Push { EyeBatch batch; };

// false: a path tracer. true: light that estimated lobes scatter more than once is left to the photon map.
layout(constant_id = 0) const bool photon_map = false;
// Whether some surface lets light pass (alpha below 1).
layout(constant_id = 1) const bool blended = true;
// Whether some surface is modified Phong.
layout(constant_id = 2) const bool phong = true;
// Whether that is asked one scattering later, but for caustics; whether there are any.
layout(constant_id = 3) const bool final_gather = false;
layout(constant_id = 4) const bool caustics = true;

#include "layers.glsl"

const RayRecord no_ray = RayRecord(0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0u);

float power_heuristic(float a, float b) {
    // Quotients first: squares of densities overflow.
    float r = b / a;
    return 1.0 / (1.0 + r * r);
}

RayRecord make_ray(Surface surface, vec3 direction, float t_max) {
    vec3 o = offset_ray_origin(surface.position, surface.error, surface.geometric_normal, direction);
    return RayRecord(o.x, o.y, o.z, t_max, direction.x, direction.y, direction.z, 0u);
}

// Whether the path ends where estimated lobes scatter it, but for a ray that seeks emission.
bool ends_at_estimated(uint state) {
    return photon_map && (!final_gather || (state & path_estimated) != 0u);
}

// Light that photons bring is not counted twice.
void add_emission(uint slot, PathRecord path, vec3 radiance) {
    uint layer = layer_of_emission(path.state);
    if (!final_gather || layer != layer_caustic) {
        add_to_layer(slot, layer, radiance);
    }
}

// onward: those of the estimated lobes that the path is scattered by as well.
void sample_light(uint slot, PathRecord path, vec3 throughput, Surface surface, Frame frame, MaterialRecord m, vec3 wo,
                  uint estimated, uint onward, uint followed, float estimated_probability) {
    bool ends = ends_at_estimated(path.state);
    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, path.vertices * 2u + 1u);
    float choice_probability;
    LightRecord light = lights[choose_light(u.x, choice_probability)];
    LightSample s;
    vec3 o = offset_ray_origin(surface.position, surface.error, surface.geometric_normal, surface.geometric_normal);
    if (!light_sample(light, o, u.yz, s)) {
        return;
    }
    vec3 wi = to_local(frame, s.wi);
    bool sky_by_cosine = ends && light.kind == light_sky;
    if (sky_by_cosine) {
        // Nothing else finds the sky for diffuse lobes here: not evenly over the sphere, half of which is below.
        wi = sample_cosine_hemisphere(u.yz);
        s.wi = to_world(frame, wi);
        s.radiance = light_color(light) * (PI / max(wi.z, 1e-6));
    }
    if (!(dot(s.wi, surface.geometric_normal) > 0.0)) {
        return;
    }
    vec3 arriving = throughput * s.radiance * (wi.z / choice_probability);
    float weight = 1.0;     // for the lobes of `onward`; the others have nothing but this sample
    if (!s.delta && onward != 0u) {
        float density = choice_probability * s.pdf;
        weight = sky_by_cosine ? 0.0
                               : power_heuristic(density, estimated_probability * bsdf_pdf(m, wo, wi, onward));
    }
    vec3 e = arriving * weight * bsdf_eval(m, wo, wi, onward);
    if (onward != estimated) {
        e += arriving * bsdf_eval(m, wo, wi, estimated & ~onward);
    }
    bool behind_estimated = (path.state & path_estimated) != 0u;
    bool left_to_photons = final_gather && behind_estimated;
    vec3 f = s.delta && followed != 0u && !left_to_photons ? arriving * bsdf_eval(m, wo, wi, followed) : vec3(0.0);
    if (!(max_component(e) + max_component(f) > 0.0)) {
        return;
    }
    uint followed_layer = !behind_estimated                        ? layer_direct
                          : (path.state & path_followed) != 0u ? layer_caustic
                                                                : layer_indirect;
    shadow_rays[slot] = RayRecord(o.x, o.y, o.z, s.distance, s.wi.x, s.wi.y, s.wi.z, 0u);
    shadows[slot] = ShadowRecord(e.x, e.y, e.z, behind_estimated ? layer_indirect : layer_direct, f.x, f.y, f.z,
                                 followed_layer);
}

void main() {
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
    shadow_rays[slot] = no_ray;
    if (photon_map) {
        asks[i] = 0u;
    }
    bool seeks_emission = final_gather && (path.state & path_seeks_emission) != 0u;

    if (hit.triangle == no_triangle) {
        vec3 sky = vec3(scene[0].sky_r, scene[0].sky_g, scene[0].sky_b);
        if (max_component(sky) > 0.0) {
            bool found_twice = path.pdf > 0.0 && !seeks_emission;
            float weight = found_twice ? power_heuristic(path.pdf, scene[0].sky_probability * 0.25 * INV_PI) : 1.0;
            add_emission(slot, path, throughput * sky * weight);
        }
        return;
    }

    Surface surface = load_surface(hit, direction);
    MaterialRecord m = materials[triangles[hit.triangle].w];
    m.coverage = blended ? m.coverage : 1.0;
    m.exponent = phong ? m.exponent : -1.0;
    vec3 emission = vec3(m.emission_r, m.emission_g, m.emission_b);
    if (max_component(emission) > 0.0 && (surface.front || m.double_sided != 0u)) {
        float weight = 1.0;
        if (path.pdf > 0.0) {
            float cosine = max(-dot(direction, surface.geometric_normal), 1.0e-12);
            float sides = m.double_sided != 0u ? 2.0 : 1.0;
            weight = power_heuristic(path.pdf, emitter_density(emission, sides, scene[0].light_weight, hit.t, cosine));
        }
        add_emission(slot, path, throughput * emission * weight);
    }
    if (seeks_emission || ((path.state & path_estimated) != 0u && (path.state & path_depth_mask) >= batch.bounces)) {
        return;
    }
    // From here on the state's depth is that of this vertex: scatterings between the first estimated vertex and it.
    Frame frame = make_frame(surface.shading_normal);
    vec3 wo = to_local(frame, -direction);
    uint followed = followed_lobes(m, scene[0].follow_roughness);
    uint estimated = estimated_lobes(m, scene[0].follow_roughness);
    float followed_albedo = followed != 0u ? max_component(bsdf_albedo(m, wo, surface.front, followed)) : 0.0;
    // The map answers for what else lies behind the last estimated vertex; but shadow rays alone would make bright dots
    // of lights that a glossy lobe reflects there, so one more ray looks for them.
    bool ends = ends_at_estimated(path.state);
    uint onward = !ends ? estimated : final_gather ? estimated & LOBE_GLOSSY : 0u;
    float estimated_albedo = onward != 0u ? max_component(bsdf_albedo(m, wo, surface.front, onward)) : 0.0;
    float albedo = followed_albedo + estimated_albedo;
    float estimated_probability = albedo > 0.0 ? estimated_albedo / albedo : 0.0;

    if (scene[0].light_count > 0u && ((estimated | followed) & (LOBE_DIFFUSE | LOBE_GLOSSY)) != 0u) {
        sample_light(slot, path, throughput, surface, frame, m, wo, estimated, onward, followed,
                     estimated_probability);
    }
    uint asks_for = asks_map;
    uint flags = surface.front ? query_front : 0u;
    uint scatterings = batch.bounces;   // of photons at most
    if (final_gather && (path.state & path_estimated) != 0u) {
        flags |= query_gathers;
        scatterings -= (path.state & path_depth_mask) + 1u;     // this one among them
    } else if (final_gather) {
        asks_for = asks_caustics;
        flags |= query_caustics;
    }
    if (photon_map && estimated != 0u && scatterings > 0u && (asks_for == asks_map || caustics)) {
        // If answers are shared, all ask; else every few samples, which count for all.
        bool shares = batch.shares_queries != 0u;
        bool white = shares && is_lambertian(m);
        if (shares || (path.sample_index - batch.first_sample) % batch.query_step == 0u) {
            vec3 counts_by = throughput * (white    ? bsdf_albedo(m, wo, surface.front, LOBE_DIFFUSE)
                                           : shares ? vec3(1.0)
                                                    : vec3(batch.query_weight));
            flags |= min(scatterings, most_scatterings_known) << query_scatterings_shift;
            if (white) {
                flags |= query_white;
            } else if (shares) {
                float all = max_component(bsdf_albedo(m, wo, surface.front, estimated));
                float glossy = max_component(bsdf_albedo(m, wo, surface.front, estimated & LOBE_GLOSSY));
                float share = clamp(glossy / max(all, 1e-9), 0.0, 1.0);
                flags |= direction_steps(max(ggx_alpha(m), SMALLEST_ALPHA), share) << query_steps_shift;
            }
            asks[i] = asks_for;
            queries[slot] = QueryRecord(surface.position.x, surface.position.y, surface.position.z,
                                        triangles[hit.triangle].w, counts_by.x, counts_by.y, counts_by.z,
                                        pack_unit(-direction), pack_unit(surface.geometric_normal),
                                        pack_unit(surface.shading_normal), estimated, flags);
        }
    }
    if (!(albedo > 0.0)) {
        return;
    }

    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, path.vertices * 2u + 2u);
    bool takes_estimated = u.w < estimated_probability;
    BsdfSample s;
    uint lobes = takes_estimated ? onward : followed;
    if (!bsdf_sample(m, wo, surface.front, lobes, u, s)) {
        return;
    }
    vec3 wi = blended && s.lobe == LOBE_PASS ? direction : to_world(frame, s.wi);
    // The sampled side and the geometric side must be the same, or light would pass through the surface.
    if ((s.wi.z > 0.0) != (dot(wi, surface.geometric_normal) > 0.0)) {
        return;
    }
    float probability = takes_estimated ? estimated_probability : 1.0 - estimated_probability;
    throughput *= s.weight * (s.eta_scale / probability);
    path.vertices += 1u;
    if (path.vertices >= 3u) {
        float survival = min(max_component(throughput), 0.95);
        // What is left of the number that chose between the lobes is uniform again.
        float left = takes_estimated ? u.w / probability : (u.w - estimated_probability) / probability;
        if (!(left < survival)) {
            return;
        }
        throughput /= survival;
    }
    if (!(max_component(throughput) > 0.0)) {
        return;
    }
    rays[slot] = make_ray(surface, wi, far_away);
    path.throughput_r = throughput.x;
    path.throughput_g = throughput.y;
    path.throughput_b = throughput.z;
    path.pdf = takes_estimated ? estimated_probability * s.pdf : 0.0;
    path.state = state_after(path.state, !takes_estimated);
    if (ends && takes_estimated) {
        path.state |= path_seeks_emission;
    }
    paths[slot] = path;
    alive[i] = 1u;
}
