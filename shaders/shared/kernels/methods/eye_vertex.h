// One vertex of each active eye path: adds the emission that the path hit, writes a shadow ray and
// a query of the photon map, and samples the ray on which the path continues.
#include "shared/kernels/layers.h"
#include "shared/kernels/scene.h"
#include "shared/kernels/sky.h"
#include "shared/kernels/textures.h"

#include "shared/kernels/culled.h"
#include "shared/kernels/dispersion.h"
#include "shared/kernels/emission.h"
#include "shared/kernels/medium.h"
#include "shared/kernels/methods/light_paths.h"
#include "shared/kernels/methods/shadow_rays.h"
#include "shared/kernels/normals.h"

#include "shared/kernels/anisotropy.h"
#include "shared/kernels/coat.h"

// A vertex on a surface. Its path's state counts the scatterings between the first estimated vertex
// and this one.
struct Vertex {
    uint index; // of the path among the active ones
    uint slot;
    uint query; // query_kind_* of what it asks the photon map
    PathRecord path;
    vec3 throughput;
    vec3 direction; // of the ray that hit this vertex
    vec3 toward;    // where it came from, or above the horizon (toward_above)
    uint triangle;
    uint cone; // of the ray
    real distance;
    uint solids; // in which the ray came (kernels/medium.h)
    bool hidden; // inside a solid of higher rank
    Surface surface;
    MaterialRecord material;
    Frame frame; // of the shading normal
    vec3 wo;
    uint followed, estimated; // lobes, see shared/follow.h
    bool ends;                // at the estimated lobes, unless the ray seeks emission
    uint onward;              // estimated lobes that also scatter the path
    LobeAlbedos albedos;
    real albedo;                // of the lobes that scatter the path, and what passes
    real estimated_probability; // probability that `onward` scatters the path
    real pass_probability;      // probability that the path goes straight on
};

// Whether paths query the photon map one scattering later, except for caustics.
FN bool final_gather() { return variant == variant_final_gather; }

// Whether light paths find the same light as the eye paths of a path tracer.
FN bool has_light_paths() { return variant == variant_light_paths; }

FN bool has_light(uint kind) { return (light_kinds & (1u << kind)) != 0u; }

// Whether rays can find light. Kernels that may have every kind of light ask the scene.
FN bool has_sky() {
    return (has_light(light_sky) || has_light(light_picture)) &&
           scene[0].sky_probability > real(0.0);
}
FN bool has_emitters() {
    return has_light(light_triangle) && scene[0].emitter_probability > real(0.0);
}

FN real power_heuristic(real a, real b) {
    // Divide first: squares of densities overflow.
    real r = b / a;
    return real(1.0) / (real(1.0) + r * r);
}

FN RayRecord make_ray(IN(Surface) surface, vec3 direction, real t_max) {
    vec3 o =
        offset_ray_origin(surface.position, surface.error, surface.geometric_normal, direction);
    return RayRecord(o.x, o.y, o.z, t_max, direction.x, direction.y, direction.z, 0u);
}

FN uint vertices_of(IN(PathRecord) path) { return path.vertices & path_vertices_mask; }

// Records that refraction scales the path's throughput, and returns by how much it has done so in
// all.
FN real scale_by_refraction(INOUT(PathRecord) path, IN(MaterialRecord) m, real scale) {
    if (!may_have(m, MATERIAL_SOLID)) {
        return real(1.0);
    }
    real all = bits_float(path.vertices & ~path_vertices_mask) * scale;
    path.vertices = vertices_of(path) | (float_bits(all) & ~path_vertices_mask);
    return all;
}

FN bool behind_estimated(IN(PathRecord) path) { return (path.state & path_estimated) != 0u; }

FN bool is_culled(IN(Vertex) v) {
    return is_culled(v.material, v.surface.front) && !behind_estimated(v.path);
}

FN bool seeks_emission(IN(PathRecord) path) {
    return photon_map && (path.state & path_seeks_emission) != 0u;
}

// Whether photons account for the light of this layer that the path finds. Caustics come from the
// map at the estimated vertex, and must not count twice where paths go on behind it.
FN bool left_to_photons(uint state, uint layer) {
    return photon_map && (layer == layer_caustic || (state & path_near_followed) != 0u);
}

// Whether the path goes on here although it only seeks emission: light that nearby surfaces scatter
// is not in the map.
FN bool follows_near(real distance) {
    return photon_map && scene[0].follows_near != 0u && distance < scene[0].near_distance;
}

FN void add_emission(uint slot, IN(PathRecord) path, vec3 radiance) {
    uint layer = layer_of_emission(path.state);
    if (!left_to_photons(path.state, layer)) {
        add_to_layer(slot, layer, radiance);
    }
}

// Share of the eye path in light that it finds beside light paths. They find no direct light, and
// only what is scattered first by estimated lobes in view. by_light_path, by_shadow_ray,
// by_scattering: densities at the path's last vertex.
FN real eye_share(IN(PathRecord) path, real by_light_path, real by_shadow_ray, real by_scattering) {
    bool both = behind_estimated(path) && (path.state & path_depth_mask) > 0u;
    return both ? real(1.0) - share_of_light_paths(by_light_path, by_shadow_ray, by_scattering)
                : real(1.0);
}

// The same for emission that a scattered ray hits. light: its index; origin, direction: of photons
// that leave it there towards the path, at this distance; shadow_ray: density of shadow rays.
FN real share_of_emission(uint slot, IN(PathRecord) path, uint light, vec3 origin, vec3 direction,
                          real distance, real shadow_ray, real sky_pdf) {
    if (!has_light_paths()) {
        return real(1.0);
    }
    EyeWeightRecord w = eye_weights[slot];
    if (!(w.scarcity > float32(0.0))) {
        return real(1.0);
    }
    real photons = density_of_light(light, lights[light], real(batch.light_paths), origin,
                                    direction, distance, sky_pdf);
    return eye_share(path, w.scarcity * photons, w.last * shadow_ray, real(1.0));
}

// The sky is the last light.
FN real share_of_sky(uint slot, IN(PathRecord) path, vec3 direction, real pdf) {
    return share_of_emission(slot, path, scene[0].light_count - 1u, vec3(real(0.0)), -direction,
                             real(1.0), scene[0].sky_probability * pdf, pdf);
}

// Adds the sky's emission to the path of a ray that leaves the scene.
FN void add_sky(uint slot, IN(PathRecord) path, vec3 direction, vec3 throughput) {
    vec3 even = vec3(scene[0].sky_r, scene[0].sky_g, scene[0].sky_b);
    if (has_light(light_sky) && max_component(even) > real(0.0)) {
        real weight =
            path.pdf > real(0.0)
                ? power_heuristic(path.pdf, scene[0].sky_probability * real(0.25) * INV_PI)
                : real(1.0);
        weight *= share_of_sky(slot, path, direction, UNIFORM_SPHERE_PDF);
        add_emission(slot, path, throughput * even * weight);
    }
    if (has_light(light_picture) && scene[0].sky_columns > 0u) {
        SkyPoint seen = sky_at(direction, path.pdf > real(0.0) || has_light_paths());
        real weight = path.pdf > real(0.0)
                          ? power_heuristic(path.pdf, scene[0].sky_probability * seen.pdf)
                          : real(1.0);
        weight *= share_of_sky(slot, path, direction, seen.pdf);
        add_emission(slot, path, throughput * seen.radiance * weight);
    }
}

// The light that is this emissive triangle. Emissive triangles are lights in their own order.
FN uint light_of_triangle(uint triangle) {
    uint first = scene[0].first_emitter;
    uint count = scene[0].emitter_count;
    while (count > 1u) {
        uint half_count = count / 2u;
        if (triangle_of_light(lights[first + half_count]) <= triangle) {
            first += half_count;
            count -= half_count;
        } else {
            count = half_count;
        }
    }
    return first;
}

// Solid-angle density with which shadow rays find this point of an emissive triangle; see
// emitter_density. index: of the light.
FN real shadow_ray_density(uint index, HitRecord hit, real cosine) {
    real probability = probability_for_shadow_rays(index);
    LightRecord light = lights[index];
    real area;
    light_normal(light, area);
    if (shines_by_texels(light)) {
        probability *= density_by_texels(light, hit.u, hit.v);
    }
    return emitter_density(probability, area, hit.t, cosine);
}

// share_of_emission() of the triangle that the path hit. Texels of emission do not count.
FN real share_of_surface_emission(IN(Vertex) v, uint index, HitRecord hit, real cosine) {
    real area;
    light_normal(lights[index], area);
    real shadow_ray = emitter_density(probability_for_shadow_rays(index), area, hit.t, cosine);
    return share_of_emission(v.slot, v.path, index, v.surface.position, -v.direction, hit.t,
                             shadow_ray, real(1.0));
}

FN void add_surface_emission(IN(Vertex) v, HitRecord hit) {
    MaterialRecord m = v.material;
    vec3 emission = vec3(m.emission_r, m.emission_g, m.emission_b);
    if (has_light(light_triangle) && max_component(emission) > real(0.0) &&
        (v.surface.front || m.double_sided != 0u)) {
        real weight = real(1.0);
        bool both_find = has_light_paths() && behind_estimated(v.path);
        if (v.path.pdf > real(0.0) || both_find) {
            uint index = light_of_triangle(hit.triangle);
            real cosine = max(-dot(v.direction, v.surface.geometric_normal), real(1.0e-12));
            if (v.path.pdf > real(0.0)) {
                weight = power_heuristic(v.path.pdf, shadow_ray_density(index, hit, cosine));
            }
            if (both_find) {
                weight *= share_of_surface_emission(v, index, hit, cosine);
            }
        }
        add_emission(v.slot, v.path, v.throughput * emission * weight);
    }
}

// Adds what the eye sees of a surface without light. It lights nothing, so that photons need not
// leave it.
FN void add_unlit(IN(Vertex) v) {
    if (is_unlit(v.material) && !behind_estimated(v.path)) {
        add_to_layer(v.slot, layer_direct,
                     v.throughput * base_color(v.material) * coverage(v.material));
    }
}

// Largest probability with which the last estimated vertex sends a ray that seeks emission. On
// diffuse surfaces the ray matters only under the sky, near emissive triangles, and where the
// photon map's estimate is not taken; and it costs a round of tracing. Followed lobes need rays for
// themselves.
FN real seek_probability(IN(Vertex) v) {
    bool goes_far = batch.untaken == untaken_often;
    if (!goes_far && !has_sky() && !has_emitters()) {
        return real(0.125); // there is no emission to find
    }
    if (v.followed != 0u || v.pass_probability > real(0.0)) {
        return goes_far ? real(0.5) : real(0.25);
    }
    bool often = goes_far || has_sky() || (v.estimated & LOBE_GLOSSY) != 0u;
    return often ? real(1.0) : real(0.25);
}

// Decides which lobes scatter the path, and with which probabilities.
FN void split_lobes(HitRecord hit, INOUT(Vertex) v) {
    v.frame = make_frame(v.surface.shading_normal);
    turn_anisotropy(hit, v.surface, v.frame, v.material);
    turn_coat(hit, v.surface, v.frame, v.material);
    v.wo = to_local(v.frame, v.toward);
    v.followed = followed_paths ? followed_lobes(v.material, scene[0].follow_roughness) : 0u;
    v.estimated = bsdf_lobes(v.material) & ~v.followed;
    v.albedos = lobe_albedos(v.material, v.wo, v.surface.front, v.followed | v.estimated);
    real followed_albedo = max_component(sum_of_albedos(v.albedos, v.followed));
    v.ends = photon_map && (!final_gather() || behind_estimated(v.path));
    // The map accounts for all other light behind the last estimated vertex. But if only shadow
    // rays found lights there, those that touch the surface or that a glossy lobe reflects would
    // become fireflies. One more ray looks for them. The path goes on there if the map's estimate
    // is not taken.
    bool seeks = batch.untaken != untaken_never || (direct_light && (has_sky() || has_emitters()));
    v.onward = !v.ends || seeks ? v.estimated : 0u;
    real estimated_albedo = max_component(sum_of_albedos(v.albedos, v.onward));
    real passes = pass_share(v.material);
    v.albedo = followed_albedo + estimated_albedo + passes;
    v.estimated_probability = v.albedo > real(0.0) ? estimated_albedo / v.albedo : real(0.0);
    v.pass_probability = passes;
    if (v.ends) {
        v.estimated_probability = min(v.estimated_probability, seek_probability(v));
    }
    if (passes > real(0.0)) {
        v.pass_probability =
            passes / (passes + followed_albedo) * (real(1.0) - v.estimated_probability);
    }
}

// Lets the path only go straight on.
FN void only_pass(INOUT(Vertex) v) {
    v.followed = 0u;
    v.onward = 0u;
    v.estimated_probability = real(0.0);
    v.pass_probability = real(1.0);
}

// Whether this followed lobe scatters the path.
FN bool scatters(IN(Vertex) v, uint lobe) {
    return may_have(v.material, lobe) && (v.followed & lobe) != 0u;
}

// Probability with which followed lobes scatter the path.
FN real followed_probability(IN(Vertex) v) {
    real scattered = may_have(v.material, MATERIAL_ALPHA) && v.pass_probability > real(0.0)
                         ? real(1.0) - v.pass_probability
                         : real(1.0);
    return scattered - v.estimated_probability;
}

// A sample of a light, as seen from the vertex.
struct SeenLight {
    vec3 origin; // of the shadow ray
    LightSample s;
    vec3 wi; // in the vertex's frame
    ChosenLight choice;
    real texels; // density of points on it that is due to texels
};

// Chooses a light and samples it. Returns false if no light arrives.
FN bool choose_light_sample(IN(Vertex) v, OUT(SeenLight) l) {
    PathRecord path = v.path;
    Surface surface = v.surface;
    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, vertices_of(path) * 2u + 1u,
                         lattice);
    l.choice = choose_light(vec2(u.x, u.w), false);
    LightRecord light = lights[l.choice.index];
    if (is_light(light, light_kinds, light_picture)) {
        light = sample_picture(light, vec2(u.y, u.z));
    }
    l.wi = vec3(real(0.0));
    l.origin = offset_ray_origin(surface.position, surface.error, surface.geometric_normal,
                                 surface.geometric_normal);
    vec2 where = vec2(u.y, u.z);
    l.texels = shines_by_texels(light) ? choose_texel(light, where) : real(1.0);
    bool masked = may_have(v.material, MATERIAL_ALPHA) && is_masked_out(light, where);
    if (masked || !light_sample(light, light_kinds, l.origin, where, l.s)) {
        return false;
    }
    bool above = dot(l.s.wi, surface.geometric_normal) > real(0.0);
    if (!above && scatters(v, LOBE_CLEAR)) {
        // The light is behind the glass: its sample as seen from there.
        l.origin = offset_ray_origin(surface.position, surface.error, surface.geometric_normal,
                                     -surface.geometric_normal);
        if (!light_sample(light, light_kinds, l.origin, where, l.s)) {
            return false;
        }
        l.s.pdf *= l.texels;
        l.wi = to_local(v.frame, l.s.wi);
        return dot(l.s.wi, surface.geometric_normal) < real(0.0);
    }
    l.s.pdf *= l.texels;
    l.wi = to_local(v.frame, l.s.wi);
    return above;
}

// Radiance that one of the lobes `clear` and `coat` scatters from a light's sample, for clear on
// either side. They are followed, so the path samples the same light.
FN vec3 light_by_spread_lobe(IN(Vertex) v, IN(SeenLight) l, uint lobe) {
    bool passes = l.wi.z < real(0.0);
    if (passes != (dot(l.s.wi, v.surface.geometric_normal) < real(0.0))) {
        return vec3(real(0.0));
    }
    real pdf;
    vec3 f = spread_eval_and_pdf(v.material, v.wo, l.wi, v.surface.front, v.followed, lobe, pdf);
    if (passes) {
        real eta = interface_eta(v.material, v.surface.front);
        f = f / (eta * eta);
    }
    real weight = real(1.0);
    if (!l.s.delta) {
        weight = power_heuristic(l.choice.probability * l.s.pdf, followed_probability(v) * pdf);
    }
    vec3 arriving = v.throughput * l.s.radiance * (abs(l.wi.z) / l.choice.probability);
    if (may_have(v.material, MATERIAL_ABSORPTION)) {
        arriving *= transmittance(solids_after(v.solids, v.material, v.surface.front, passes),
                                  l.s.distance);
    }
    return arriving * f * weight;
}

// Radiance that the lobes `estimated` or `followed` scatter from a light's sample. weighs: the path
// samples the same light by these lobes.
FN vec3 light_by_lobes(IN(Vertex) v, IN(SeenLight) l, uint lobes, bool weighs) {
    vec4 probabilities = weighs ? lobe_probabilities(v.material, v.wo, lobes) : vec4(real(0.0));
    real pdf;
    vec3 f =
        bsdf_eval_and_pdf(reflection_parameters(v.material), v.wo, l.wi, lobes, probabilities, pdf);
    real weight =
        weighs ? power_heuristic(l.choice.probability * l.s.pdf, v.estimated_probability * pdf)
               : real(1.0);
    vec3 arriving = v.throughput * l.s.radiance * (l.wi.z / l.choice.probability);
    if (may_have(v.material, MATERIAL_ABSORPTION)) {
        arriving *= transmittance(v.solids, l.s.distance);
    }
    return arriving * weight * f;
}

// eye_share() of light that a shadow ray finds, for the estimated lobes and for the followed ones.
FN vec2 shares_of_shadow_ray(IN(Vertex) v, IN(SeenLight) l) {
    vec2 shares = vec2(real(1.0));
    EyeWeightRecord w = eye_weights[v.slot];
    if (!(w.scarcity > float32(0.0)) || !behind_estimated(v.path)) {
        return shares;
    }
    // Light paths follow this vertex: its scattering counts.
    PathRecord next = v.path;
    next.state = state_after(next.state, false);
    LightSample s = l.s;
    real probability = l.choice.probability;
    real sky_pdf = s.pdf; // of a light that is no sky it does not count
    real photons = w.scarcity *
                   density_of_light(l.choice.index, lights[l.choice.index], real(batch.light_paths),
                                    l.origin + s.wi * s.distance, -s.wi, s.distance, sky_pdf);
    real cosine = abs(dot(s.wi, v.surface.geometric_normal));
    if (s.delta) {
        shares.x = eye_share(next, photons * cosine * INV_PI, probability, real(0.0));
        shares.y = eye_share(next, photons, real(0.0), real(0.0));
        return shares;
    }
    shares.x = eye_share(next, photons, probability * s.pdf / l.texels * PI / cosine, real(1.0));
    shares.y = eye_share(next, photons, real(0.0), real(1.0));
    return shares;
}

// Writes a shadow ray to a light, and the radiance that it adds if nothing blocks it.
FN void sample_light(IN(Vertex) v) {
    SeenLight l;
    if (!choose_light_sample(v, l)) {
        return;
    }
    LightSample s = l.s;
    bool behind = behind_estimated(v.path);
    uint estimated_layer = behind ? layer_indirect : layer_direct;
    uint followed_layer =
        behind && (v.path.state & path_followed) != 0u ? layer_caustic : estimated_layer;
    bool samples_followed =
        !left_to_photons(v.path.state, followed_layer) && !seeks_emission(v.path);
    vec3 by_followed = vec3(real(0.0));
    if (scatters(v, LOBE_CLEAR) && samples_followed) {
        by_followed += light_by_spread_lobe(v, l, LOBE_CLEAR);
    }
    if (scatters(v, LOBE_COAT) && samples_followed) {
        by_followed += light_by_spread_lobe(v, l, LOBE_COAT);
    }
    // By followed lobes the path finds all but delta lights. A loop, so that the kernel holds the
    // code of the BSDF once.
    vec3 by_estimated = vec3(real(0.0));
    uint sets = s.delta && v.followed != 0u && samples_followed ? 2u : 1u;
    for (uint set = 0u; set < sets; ++set) {
        bool weighs = set == 0u && !s.delta && v.onward != 0u;
        vec3 light = light_by_lobes(v, l, set == 0u ? v.estimated : v.followed, weighs);
        if (set == 0u) {
            by_estimated = light;
        } else {
            by_followed += light;
        }
    }
    if (has_light_paths()) {
        vec2 shares = shares_of_shadow_ray(v, l);
        by_estimated *= shares.x;
        by_followed *= shares.y;
    }
    if (!(max_component(by_estimated) + max_component(by_followed) > real(0.0))) {
        return;
    }
    shadow_rays[v.slot] =
        RayRecord(l.origin.x, l.origin.y, l.origin.z, s.distance, s.wi.x, s.wi.y, s.wi.z, 0u);
    shadows[v.slot] = ShadowRecord(by_estimated.x, by_estimated.y, by_estimated.z,
                                   estimated_layer | followed_layer << 2u, by_followed.x,
                                   by_followed.y, by_followed.z, l.choice.index);
}

// Steps in which queries may share the estimate of a glossy surface (query_steps_shift).
FN uint shared_direction_steps(IN(Vertex) v) {
    MaterialRecord m = v.material;
    real all = max_component(sum_of_albedos(v.albedos, v.estimated));
    real glossy = max_component(sum_of_albedos(v.albedos, v.estimated & LOBE_GLOSSY));
    real share = clamp(glossy / max(all, real(1e-9)), real(0.0), real(1.0));
    uint steps = direction_steps(max(ggx_alpha(m), SMALLEST_ALPHA), share);
    return has_sheen(m) ? max(steps, 8u) : steps;
}

// BRDF of a Lambertian surface [1/sr], computed from the packed vectors of a query.
FN vec3 lambertian_reflectance(IN(Vertex) v, uint direction, uint shading_normal) {
    vec3 wo = to_local(make_frame(unpack_unit(shading_normal)), unpack_unit(direction));
    if (!(wo.z > real(0.0))) {
        return vec3(real(0.0));
    }
    return diffuse_reflectance(reflection_parameters(v.material), wo.z, real(1.0)) * INV_PI;
}

FN uint mixed(uint key, vec3 values) { return pcg4d(uvec4(float_bits(values), key)).x; }

// Queries whose keys differ share no answer: those of different materials and of different texels.
FN uint material_key(IN(Vertex) v) {
    uint index = triangles[v.triangle].w;
    if (!vertex_colors && !(textured && v.material.textures != 0u)) {
        return index;
    }
    MaterialRecord m = v.material;
    uvec3 color = float_bits(vec3(m.base_r, m.base_g, m.base_b));
    uvec3 others = float_bits(vec3(m.metallic, m.roughness, m.coverage));
    uint key = pcg4d(uvec4(color, index) ^ pcg4d(uvec4(others, 0u))).x;
    if (may_have(m, MATERIAL_COAT_NORMAL)) {
        key = mixed(key, floor(real(8.0) * coat_normal(m) + vec3(real(0.5))));
    }
    if (!other_textures || (m.textures & material_other_textures) == 0u) {
        return key;
    }
    key = mixed(key, vec3(m.specular_r, m.specular_g, m.specular_b));
    key = mixed(key, vec3(m.specular, m.transmission, m.thickness));
    key = mixed(key, vec3(m.coat, m.film, m.film_thickness));
    key = mixed(key, vec3(m.sheen_r, m.sheen_g, m.sheen_b));
    // In eighths: it is turned into the shading frame, which differs from place to place.
    vec2 eighths = floor(real(8.0) * anisotropy(m) + real(0.5));
    return mixed(key, vec3(m.sheen_roughness, eighths.x, eighths.y));
}

// Writes a query of the photon map for the estimated lobes.
FN void leave_query(INOUT(Vertex) v) {
    uint kind = query_kind_map;
    uint flags = v.surface.front ? query_front : 0u;
    uint scatterings = batch.bounces; // most scatterings of a photon that counts
    if (behind_estimated(v.path)) {
        kind = query_kind_gathers;
        flags |= query_gathers;
        scatterings -= (v.path.state & path_depth_mask) + 1u; // including the one at this vertex
    } else if (final_gather()) {
        kind = query_kind_caustics;
        flags |= query_caustics;
    }
    // Without shadow rays, photons that were not scattered yet count, too.
    bool wanted = v.estimated != 0u && (scatterings > 0u || !direct_light);
    // If paths share estimates, every path queries; else every few samples do, and their answers
    // count for all.
    bool shares = batch.shares_queries != 0u;
    if (!wanted ||
        !(shares || (v.path.sample_index - batch.first_sample) % batch.query_step == 0u)) {
        return;
    }
    v.query = kind;
    query_kinds[v.slot] = kind;
    if (kind == query_kind_caustics && !followed_paths) {
        // There are none. The path waits nevertheless: which queries share answers must not depend
        // on what the scene requires.
        return;
    }
    // Lambertian surfaces share irradiance, which their albedo turns into radiance.
    bool lambertian = !glossy_estimates || is_lambertian(v.material);
    bool shares_irradiance = shares && lambertian;
    vec3 counts_by = v.throughput;
    if (shares_irradiance) {
        counts_by = v.throughput * v.albedos.diffuse;
    } else if (!shares) {
        counts_by = v.throughput * vec3(batch.query_weight);
    }
    flags |= min(scatterings, most_scatterings_known) << query_scatterings_shift;
    flags |= v.estimated << query_lobes_shift;
    uint direction = pack_unit(v.toward);
    uint shading_normal = pack_unit(v.surface.shading_normal);
    vec3 reflectance = vec3(INV_PI);
    if (lambertian) {
        flags |= query_lambertian;
        if (!shares_irradiance) {
            reflectance = lambertian_reflectance(v, direction, shading_normal);
        }
    } else {
        if (shares) {
            flags |= shared_direction_steps(v) << query_steps_shift;
        }
        query_bsdfs[v.slot] =
            query_bsdf(reflection_parameters(v.material), direction, shading_normal);
    }
    vec3 p = v.surface.position;
    queries[v.slot] = QueryRecord(p.x, p.y, p.z, pack_unit(v.surface.geometric_normal), counts_by.x,
                                  counts_by.y, counts_by.z, flags, reflectance.x, reflectance.y,
                                  reflectance.z, material_key(v));
}

// Writes the path that continues on rays[v.slot], once its query is answered.
FN void leave_path(IN(Vertex) v, PathRecord path, vec3 throughput) {
    path.throughput_r = throughput.x;
    path.throughput_g = throughput.y;
    path.throughput_b = throughput.z;
    paths[v.slot] = path;
    if (v.query != 0u) {
        query_kinds[v.slot] = v.query | query_then_continues;
    } else {
        alive[v.index] = 1u;
    }
}

// Light paths find what is close to lights themselves.
FN bool has_close_lights() {
    return direct_light && (has_light(light_point) || has_light(light_spot)) &&
           !has_light_paths() && scene[0].close_light_count > 0u;
}

FN bool is_near_close_light(IN(Vertex) v) {
    if (!has_close_lights()) {
        return false;
    }
    for (uint i = 0u; i < scene[0].close_light_count; ++i) {
        real distance;
        unit_and_length(vec3(vec4(scene[0].close_lights[i])) - v.surface.position, distance);
        if (distance < real(scene[0].close_reaches[i])) {
            return true;
        }
    }
    return false;
}

// Below this throughput, Russian roulette decides whether a path goes straight on.
CONSTANT real least_passing = real(0.125);

// Goes straight on where the surface is absent. That is no scattering: the path stays what it was.
// u: in [0,1).
FN void pass_surface(IN(Vertex) v, real u) {
    PathRecord path = v.path;
    path.vertices += 1u;
    if (is_culled(v) || v.hidden) {
        path.pdf = real(0.0); // shadow rays do not find what is behind it
        if (has_light_paths() && eye_weights[v.slot].scarcity < float32(0.0)) {
            eye_weights[v.slot].scarcity = float32(0.0); // nor do light paths find the eye
        }
    }
    // Solids absorb on the whole way, once its end is known.
    vec3 arrived = vec3(path.throughput_r, path.throughput_g, path.throughput_b);
    vec3 throughput = arrived * (pass_share(v.material) / v.pass_probability);
    real refracted = scale_by_refraction(path, v.material, real(1.0));
    real survival = min(max_component(throughput) / (refracted * least_passing), real(1.0));
    if (is_near_close_light(v)) {
        survival = real(1.0);
    }
    if (u < survival) {
        rays[v.slot].t_max =
            goes_on_past(rays[v.slot].t_max, v.solids, v.material, v.surface.front, v.hidden);
        leave_path(v, path, throughput / survival);
    }
}

// Keeps the densities of a scattering by estimated or followed lobes.
FN void weigh_scattering(IN(Vertex) v, bool estimated, IN(BsdfSample) s, vec3 wi) {
    EyeWeightRecord w = eye_weights[v.slot];
    if (w.scarcity < float32(0.0)) {
        real density = -w.scarcity;
        if (w.last > float32(0.0)) { // of a perspective camera
            density = density / v.distance / v.distance;
        }
        real cosine = dot(v.direction, v.surface.geometric_normal);
        w.scarcity = estimated ? float32(scarcity_of_eye_paths(density, cosine, s.pdf / s.wi.z))
                               : float32(0.0);
    }
    w.last = estimated ? float32(PI / abs(dot(wi, v.surface.geometric_normal))) : float32(0.0);
    eye_weights[v.slot] = w;
}

// Whether some of the paths that these lobes scatter are aimed at what is close to lights. Paths
// that look for emission only are not, nor are those whose reflections the eye sees.
FN bool aims_at_close_lights(IN(Vertex) v, uint lobes) {
    bool only_seeks = v.ends && batch.untaken == untaken_never && scene[0].follows_near == 0u;
    bool rough = lobes != 0u && (lobes & ~(LOBE_DIFFUSE | LOBE_GLOSSY)) == 0u;
    bool in_view = (lobes & v.followed) != 0u && !behind_estimated(v.path);
    return has_close_lights() && rough && !only_seeks && !in_view;
}

FN CloseCone close_cone_from(IN(Vertex) v, uint light) {
    return close_cone(vec4(scene[0].close_lights[light]), real(scene[0].close_reaches[light]),
                      v.surface.position);
}

// Aims the path at what is close to a light, or leaves it to the lobes. Returns whether it is
// aimed. Then the sample's density is that of the lobes in its direction, and its weight is
// f |cos|, not divided by a density.
FN bool aim_at_close_light(IN(Vertex) v, uint lobes, INOUT(BsdfSample) s) {
    vec4 w = random4(batch.seed ^ 0xc105eu, v.path.pixel, v.path.sample_index, vertices_of(v.path));
    real light = w.x / real(scene[0].close_share);
    if (!(light < real(scene[0].close_light_count))) {
        return false;
    }
    CloseCone c = close_cone_from(v, uint(light));
    if (!(c.cone.height > real(0.0))) {
        return false;
    }
    s.wi = to_local(v.frame, sample_close_cone(c, vec2(w.y, w.z)));
    s.lobe = LOBE_DIFFUSE;
    s.probability = real(1.0);
    s.eta_scale = real(1.0);
    vec4 probabilities = lobe_probabilities(v.material, v.wo, lobes);
    vec3 f = bsdf_eval_and_pdf(reflection_parameters(v.material), v.wo, s.wi, lobes, probabilities,
                               s.pdf);
    s.weight = f * max(s.wi.z, real(0.0));
    return true;
}

// Divides the weight of a sample of the lobes, or of an aimed one, by the density of both together.
// The sample's own density stays that of the lobes: shadow rays weigh their light by it. Returns
// the density of both over that of the lobes.
FN real weigh_with_aimed(IN(Vertex) v, bool aimed, INOUT(BsdfSample) s) {
    vec3 direction = to_world(v.frame, s.wi);
    real share = real(scene[0].close_share);
    real of_lobes = real(1.0);
    real of_aimed = real(0.0);
    for (uint i = 0u; i < scene[0].close_light_count; ++i) {
        CloseCone c = close_cone_from(v, i);
        if (c.cone.height > real(0.0)) {
            of_lobes -= share;
            of_aimed += share * close_cone_pdf(c, direction);
        }
    }
    real density = of_lobes * s.pdf + of_aimed;
    if (aimed) {
        s.weight = s.weight / density;
    } else {
        s.weight *= s.pdf > real(0.0) ? s.pdf / density : real(1.0) / of_lobes;
    }
    return density / max(s.pdf, real(1.0e-30));
}

// The probability with which Russian roulette lets the path go on. throughput: after the sample, by
// which refraction has scaled it in all; concentration: how many times as many paths leave in this
// direction as the lobes scatter, which is why each carries so much less.
FN real survival_probability(IN(Vertex) v, IN(BsdfSample) s, vec3 throughput, real refracted,
                             real concentration) {
    real carried = max_component(throughput) / refracted;
    if (is_near_close_light(v)) {
        // There is much light to find, whatever the path carries: only this vertex counts.
        carried = max_component(throughput) / (max_component(v.throughput) * s.eta_scale);
    }
    return min(carried * max(concentration, real(1.0)), real(0.95));
}

// Samples the ray on which the path continues, unless Russian roulette ends the path or nothing is
// scattered.
FN void continue_path(INOUT(Vertex) v) {
    PathRecord path = v.path;
    vec4 u = eye_random4(batch.seed, path.pixel, path.sample_index, vertices_of(path) * 2u + 2u,
                         lattice);
    bool takes_estimated = u.w < v.estimated_probability;
    real scattered = real(1.0);
    if (may_have(v.material, MATERIAL_ALPHA) && v.pass_probability > real(0.0)) {
        scattered = real(1.0) - v.pass_probability;
        if (!takes_estimated && u.w >= scattered) {
            pass_surface(v, (u.w - scattered) / v.pass_probability);
            return;
        }
    }
    BsdfSample s;
    uint lobes = takes_estimated ? v.onward : v.followed;
    bool aims = aims_at_close_lights(v, lobes);
    bool aimed = aims && aim_at_close_light(v, lobes, s);
    if (!aimed && !bsdf_sample(v.material, v.wo, v.surface.front, lobes, u, s)) {
        return;
    }
    real concentration = aims ? weigh_with_aimed(v, aimed, s) : real(1.0);
    vec3 wi = to_world(v.frame, s.wi);
    // The sampled direction must be on the same side of both normals, or light would leak through
    // the surface.
    if ((s.wi.z > real(0.0)) != (dot(wi, v.surface.geometric_normal) > real(0.0))) {
        return;
    }
    real probability =
        takes_estimated ? v.estimated_probability : scattered - v.estimated_probability;
    vec3 throughput = v.throughput * (s.weight * (s.eta_scale / probability));
    path.vertices += 1u;
    real refracted = scale_by_refraction(path, v.material, s.eta_scale);
    if (vertices_of(path) >= 3u) {
        // What refraction takes from radiance it gives back when the path leaves the solid.
        real survival = survival_probability(v, s, throughput, refracted, concentration);
        // The remainder of the number that chose between the lobes is uniform again.
        real left =
            takes_estimated ? u.w / probability : (u.w - v.estimated_probability) / probability;
        if (!(left < survival)) {
            return;
        }
        throughput /= survival;
    }
    if (!(max_component(throughput) > real(0.0))) {
        return;
    }
    rays[v.slot] = make_ray(
        v.surface, wi,
        unbounded_in(solids_after(v.solids, v.material, v.surface.front, s.wi.z < real(0.0))));
    if (mip_maps) {
        rays[v.slot].cone = pack_cone(
            cone_width(v.cone, v.distance),
            scattered_spread(cone_spread(v.cone), real(batch.first_sample + batch.samples), s.pdf));
    }
    if (has_light_paths()) {
        weigh_scattering(v, takes_estimated, s, wi);
    }
    path.pdf = takes_estimated ? v.estimated_probability * s.pdf : real(0.0);
    if (direct_light && may_have(v.material, LOBES_SPREAD) && (s.lobe & LOBES_SPREAD) != 0u) {
        path.pdf = probability * s.pdf; // shadow rays find the same lights
    }
    if (takes_estimated) {
        path.state &= ~path_near_followed;
    } else if (seeks_emission(path)) {
        path.state |= path_near_followed;
    }
    path.state = state_after(path.state & ~path_seeks_emission, !takes_estimated);
    if (v.ends && takes_estimated) {
        path.state |= path_seeks_emission;
    }
    leave_path(v, path, throughput);
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counts[0]) {
        return;
    }
    Vertex v;
    v.index = i;
    v.slot = active_slots[i];
    v.query = 0u;
    v.path = paths[v.slot];
    HitRecord hit = hits[v.slot];
    v.direction =
        vec3(rays[v.slot].direction_x, rays[v.slot].direction_y, rays[v.slot].direction_z);
    v.throughput = vec3(v.path.throughput_r, v.path.throughput_g, v.path.throughput_b);
    alive[i] = 0u;
    if (direct_light) {
        shadow_rays[v.slot] = no_ray();
    }
    if (hit.triangle == no_triangle) {
        if (hit.u != ray_lost) {
            add_sky(v.slot, v.path, v.direction, v.throughput);
        }
        return;
    }
    v.triangle = hit.triangle;
    v.distance = hit.t;
    v.surface = load_surface(hit, v.direction);
    v.cone = rays[v.slot].cone;
    v.material = material_at(triangles[hit.triangle], hit, v.cone, v.direction);
    v.solids = solids_on_way(solids_of(rays[v.slot].t_max), v.material, v.surface.front);
    if (may_have(v.material, MATERIAL_ABSORPTION)) {
        v.throughput *= transmittance_to(v.solids, v.material, v.surface.front, hit.t);
    }
    v.hidden = is_hidden(v.solids, v.material);
    if (is_culled(v) || v.hidden) {
        v.material.coverage = float32(0.0);
    }
    turn_normal(v.material.textures, hit, v.direction, v.surface);
    v.toward = toward_above(v.surface, -v.direction);
    add_surface_emission(v, hit);
    add_unlit(v);
    bool ends = (seeks_emission(v.path) && !follows_near(hit.t)) ||
                (behind_estimated(v.path) && (v.path.state & path_depth_mask) >= batch.bounces);
    if (ends) {
        only_pass(v);
    } else {
        if (may_have(v.material, MATERIAL_DISPERSION)) {
            vec4 w = random4(batch.seed ^ 0xd15be5u, v.path.pixel, v.path.sample_index,
                             vertices_of(v.path));
            disperse(v.material, v.throughput, w.x);
        }
        refer_index(v.solids, v.material);
        split_lobes(hit, v);
        if (direct_light && scene[0].light_count > 0u &&
            ((v.estimated | v.followed) & (LOBE_DIFFUSE | LOBE_GLOSSY | LOBES_SPREAD)) != 0u) {
            sample_light(v);
        }
        if (photon_map) {
            leave_query(v);
        }
    }
    bool scatters = (v.followed | v.onward) != 0u && v.albedo > real(0.0);
    if (scatters || pass_share(v.material) > real(0.0)) {
        continue_path(v);
    }
}
