// Connects the hits of photons with the eye, as light paths of multiple importance sampling
// (shared/light_path.h): writes a shadow ray to the eye, and what the photon brings to a pixel if
// nothing blocks it. The surface is evaluated as an eye path that comes from there would see it.
#include "shared/kernels/camera_cone.h"
#include "shared/kernels/scene.h"
#include "shared/kernels/sky.h"
#include "shared/kernels/textures.h"

#include "shared/kernels/culled.h"
#include "shared/kernels/dispersion.h"
#include "shared/kernels/medium.h"
#include "shared/kernels/normals.h"

#include "shared/kernels/anisotropy.h"
#include "shared/kernels/coat.h"
#include "shared/kernels/methods/light_paths.h"
#include "shared/kernels/methods/shadow_rays.h"

// A photon at its hit.
struct ArrivingPhoton {
    uint slot;
    HitRecord hit;
    vec3 direction; // in which it travels
    vec3 flux;
    uint depth; // scatterings so far
    bool caustic;
    LightPathRecord path;
};

// The point of a surface as the eye sees it.
struct SeenPoint {
    Surface surface;
    MaterialRecord material;
    Frame frame;
    vec3 wo;
    vec3 passed; // share of the light that solids on the way to the eye let through
    bool there;  // it is neither culled nor inside a solid of higher rank
};

// The densities at the first hit behind the light.
FN LightPathRecord begin_path(IN(ArrivingPhoton) p) {
    uint index = path_lights[p.slot];
    LightRecord light = lights[index];
    Surface surface = load_surface(p.hit, p.direction);
    real cosine = abs(dot(p.direction, surface.geometric_normal));
    real sky_pdf = is_light(light, light_kinds, light_sky) ? UNIFORM_SPHERE_PDF : real(0.0);
    if (is_light(light, light_kinds, light_picture)) {
        sky_pdf = sky_at(-p.direction, true).pdf;
    }
    vec3 origin = surface.position - p.direction * p.hit.t;
    real photons =
        density_of_light(index, light, real(params.photons), origin, p.direction, p.hit.t, sky_pdf);
    real chosen = probability_for_shadow_rays(index);
    if (!is_light(light, light_kinds, light_triangle) && !is_any_sky(light, light_kinds)) {
        return LightPathRecord(photons * cosine * INV_PI, chosen, real(0.0), real(0.0));
    }
    real density = chosen * sky_pdf;
    if (is_light(light, light_kinds, light_triangle)) {
        real area;
        vec3 normal = light_normal(light, area);
        real at_light = max(abs(dot(p.direction, normal)), real(1.0e-12));
        density = emitter_density(chosen, area, p.hit.t, at_light);
    }
    return LightPathRecord(photons, density * PI / cosine, real(1.0), real(0.0));
}

// Whether the photon has passed a hidden surface on its way from the light, or does so here. Such
// surfaces block shadow rays: eye paths then find no delta lights.
FN bool passes_hidden(IN(ArrivingPhoton) p, float32 t_max) {
    if ((material_features & MATERIAL_NESTED) == 0u) {
        return false;
    }
    MaterialRecord m = load_material(triangles[p.hit.triangle].w);
    bool front = load_surface(p.hit, p.direction).front;
    bool before = goes_on_behind_hit(t_max) && light_paths[p.slot].passed_hidden > float32(0.0);
    return before || is_hidden(solids_on_way(solids_of(t_max), m, front), m);
}

// Connects the eye with the photon's hit. on_lens: as of connect_eye(). Returns false if that is
// not in the image.
FN bool is_in_image(IN(ArrivingPhoton) p, vec2 on_lens, OUT(EyeConnection) e) {
    vec3 position = load_surface(p.hit, p.direction).position;
    return connect_eye(camera[0], position, on_lens, e) && e.x >= real(0.0) &&
           e.x < real(params.width) && e.y >= real(0.0) && e.y < real(params.height);
}

// Looks at the photon's hit from the eye. channel: in [0,1), of a solid that disperses.
FN SeenPoint look_at(IN(ArrivingPhoton) p, IN(EyeConnection) e, real channel) {
    HitRecord seen = p.hit;
    seen.t = e.distance;
    uint cone = mip_maps ? camera_cone(camera[0], e.direction, real(params.samples)) : 0u;
    SeenPoint s;
    s.surface = load_surface(seen, e.direction);
    s.material = material_at(triangles[seen.triangle], seen, cone, e.direction);
    uint solids = solids_on_way(0u, s.material, s.surface.front);
    s.passed = vec3(real(1.0));
    if (may_have(s.material, MATERIAL_ABSORPTION)) {
        s.passed = transmittance_to(solids, s.material, s.surface.front, seen.t);
    }
    s.there = !is_hidden(solids, s.material) && !is_culled(s.material, s.surface.front);
    turn_normal(s.material.textures, seen, e.direction, s.surface);
    if (may_have(s.material, MATERIAL_DISPERSION)) {
        disperse(s.material, s.passed, channel);
    }
    refer_index(solids, s.material);
    s.frame = make_frame(s.surface.shading_normal);
    turn_anisotropy(seen, s.surface, s.frame, s.material);
    turn_coat(seen, s.surface, s.frame, s.material);
    s.wo = to_local(s.frame, toward_above(s.surface, -e.direction));
    return s;
}

// The photon's flux at its hit. Solids absorb on the way. Returns 0 if the surface is not there.
FN vec3 arriving_flux(IN(ArrivingPhoton) p, IN(MaterialRecord) m, bool front) {
    uint solids = solids_on_way(solids_of(rays[p.slot].t_max), m, front);
    vec3 flux = p.flux;
    if (may_have(m, MATERIAL_ABSORPTION)) {
        flux *= transmittance_to(solids, m, front, p.hit.t);
    }
    return is_hidden(solids, m) ? vec3(real(0.0)) : flux;
}

// 2 × the film's pixel at these coordinates of the image; no_place: it is not in the film.
FN uint place_in_film(real x, real y) {
    uint column = min(uint(x), params.width - 1u);
    uint row = min(uint(y), params.height - 1u);
    if (column < params.crop_x || row < params.crop_y) {
        return no_place;
    }
    column -= params.crop_x;
    row -= params.crop_y;
    return column < params.crop_width && row < params.crop_height
               ? 2u * (row * params.crop_width + column)
               : no_place;
}

// Connects the photon with the eye by the estimated lobes.
FN void connect_with_eye(IN(ArrivingPhoton) p) {
    vec4 u = random4(params.seed ^ 0x1e45u, params.first + p.slot, p.depth, p.hit.triangle);
    EyeConnection e;
    if (!is_in_image(p, vec2(u.x, u.y), e)) {
        return;
    }
    uint place = place_in_film(e.x, e.y);
    SeenPoint s = look_at(p, e, u.z);
    uint followed = followed_paths ? followed_lobes(s.material, scene[0].follow_roughness) : 0u;
    uint estimated = bsdf_lobes(s.material) & ~followed;
    vec3 wi = to_local(s.frame, -p.direction);
    real arriving = -dot(p.direction, s.surface.geometric_normal);
    if (!s.there || place == no_place || estimated == 0u || !(wi.z > real(0.0)) ||
        !(arriving > real(0.0))) {
        return;
    }
    real pdf;
    vec3 f = bsdf_eval_and_pdf(reflection_parameters(s.material), s.wo, wi, estimated,
                               lobe_probabilities(s.material, s.wo, estimated), pdf);
    real leaving = abs(dot(e.direction, s.surface.geometric_normal));
    real scarcity = scarcity_of_eye_paths(e.density, leaving, pdf / wi.z);
    real share = share_of_light_paths(scarcity * p.path.arriving, p.path.by_shadow_ray,
                                      p.path.by_scattering);
    // Photons arrive in proportion to the cosine with the geometric normal, but the BSDF is
    // weighted by the cosine with the shading normal (Veach 1997, §5.3).
    vec3 radiance = arriving_flux(p, s.material, s.surface.front) * s.passed * f *
                    (wi.z / arriving * leaving * e.density * share);
    if (!is_finite3(radiance) || !(max_component(radiance) > real(0.0))) {
        return;
    }
    vec3 o = offset_ray_origin(s.surface.position, s.surface.error, s.surface.geometric_normal,
                               s.surface.geometric_normal);
    shadow_rays[p.slot] = RayRecord(o.x, o.y, o.z, e.distance * (real(1.0) - error_bound(16)),
                                    -e.direction.x, -e.direction.y, -e.direction.z, 0u);
    splats[p.slot] = SplatRecord(radiance.x, radiance.y, radiance.z, place + (p.caustic ? 1u : 0u));
}

FN void main() {
    uint i = THREAD_INDEX;
    if (i >= counters[counter_active]) {
        return;
    }
    ArrivingPhoton p;
    p.slot = active_slots[i];
    p.hit = hits[p.slot];
    shadow_rays[p.slot] = no_ray();
    splats[p.slot] = SplatRecord(real(0.0), real(0.0), real(0.0), no_place);
    if (p.hit.triangle == no_triangle) {
        return;
    }
    RayRecord ray = rays[p.slot];
    PhotonPathRecord path = paths[p.slot];
    p.direction = vec3(ray.direction_x, ray.direction_y, ray.direction_z);
    p.flux = vec3(path.flux_r, path.flux_g, path.flux_b);
    p.depth = path.state & photon_depth_mask;
    p.caustic = (path.state & photon_followed) != 0u;
    if (p.depth == 0u) {
        LightPathRecord begun = begin_path(p);
        if (passes_hidden(p, ray.t_max)) {
            begun.passed_hidden = float32(1.0);
            begun.by_shadow_ray =
                begun.by_scattering > float32(0.0) ? begun.by_shadow_ray : float32(0.0);
        }
        light_paths[p.slot] = begun;
        return;
    }
    if (p.depth == 1u && p.caustic) {
        // Followed lobes have scattered it where shadow rays start, so these do not find it. By
        // such lobes eye paths find no delta lights.
        light_paths[p.slot].by_shadow_ray = float32(0.0);
    }
    p.path = light_paths[p.slot];
    if (p.depth <= params.bounces) {
        connect_with_eye(p);
    }
}
