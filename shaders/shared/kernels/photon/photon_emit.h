#include "shared/kernels/scene.h"
#include "shared/kernels/sky.h"
#include "shared/kernels/texels.h"

#include "shared/kernels/emission.h"
#include "shared/kernels/targets.h"

// Warps the random numbers of a photon of this light by the light's tree.
FN AimedNumbers aim(LightRecord light, vec4 u) {
    AimedNumbers a = begin_aim(u);
    uint index = aim_root(light);
    for (uint level = 0u; level < most_aim_levels; ++level) {
        AimNode node = aim_nodes[index];
        if (node.axis == aim_leaf) {
            break;
        }
        index = node.child + (descend_aim(node, a) ? 1u : 0u);
    }
    return a;
}

// The cone of one of the pass's photons, as if all were of this light.
FN uint emitted_cone(LightRecord light) {
    real photons = real(1.0) / batch.inverse_total;
    bool outside = ((1u << light.kind) & light_kinds_from_outside) != 0u;
    real width = outside ? real(scene[0].radius) * sqrt(PI / photons) : real(0.0);
    real spread = light.kind == light_directional
                      ? real(0.0)
                      : scattered_spread(real(0.0), photons, UNIFORM_SPHERE_PDF);
    return pack_cone(width, spread);
}

FN void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.count) {
        return;
    }
    uint photon = batch.first + slot;
    vec4 a = photon_random4(batch.seed, photon, 0u, numbers);
    vec4 v = photon_random4(batch.seed, photon, 1u, numbers);
    // The directions of emission and of the first scattering use one set of jointly well
    // distributed numbers: if the light is small, they determine where the photon is stored.
    vec4 u = vec4(a.x, a.y, v.x, v.y);
    // Numbers that need no good distribution.
    vec4 w = photon_random4(batch.seed, photon, dimension_of_choices, numbers);
    ChosenLight chosen = choose_light(vec2(v.w, w.x), true);
    LightRecord light = lights[chosen.index];
    real density = real(1.0); // of photons that start here, over that of even ones
    if (shines_by_texels(light)) {
        vec2 where = vec2(u.z, u.w);
        density = choose_texel(light, where);
        u.z = where.x;
        u.w = where.y;
    }
    bool shines = !is_masked_out(light, vec2(u.z, u.w));
    Sphere bounds;
    bounds.center = scene_center();
    bounds.radius = scene[0].radius;
    EmittedPhoton p;
    bool emitted;
    vec4 rest = vec4(v.z, v.w, v.x, v.y);
    bool aimed_from_outside = is_aimed_from_outside(light, light_kinds);
    AimedNumbers aimed = begin_aim(u);
    if (aimed_from_outside) {
        aimed = aim(light, u);
        u = end_aim(aimed);
    }
    if (is_light(light, light_kinds, light_picture)) {
        light = sample_picture(light, vec2(u.x, u.y));
    }
    if (aimed_from_outside) {
        emitted = light_emit_from_disc(light, light_kinds, bounds, aimed.concentration, u, rest, p);
    } else {
        emitted = light_emit_aimed(light, light_kinds, bounds, scene_targets(), u, rest, w.y, p);
    }
    emitted = emitted && shines;
    vec3 flux = emitted ? p.flux * (batch.inverse_total / chosen.probability) : vec3(real(0.0));
    if (footprints) {
        real photons = real(1.0) / batch.inverse_spread;
        differentials[slot] = differential_record(light_differential(
            light, light_kinds, p, scene[0].radius, photons * chosen.probability * density,
            photons * chosen.emitter_probability));
    }
    rays[slot] =
        RayRecord(p.origin.x, p.origin.y, p.origin.z, emitted ? far_away : -real(1.0),
                  p.direction.x, p.direction.y, p.direction.z, mip_maps ? emitted_cone(light) : 0u);
    uint state = photon_followed;
    if (aimed_from_outside) {
        state |= aimed_by(aimed.concentration / aim_even_share) << photon_outside_shift;
    } else if (emitted && ((1u << light.kind) & light_kinds_from_outside) == 0u) {
        state |= (aimed_by(p.for_targets) << photon_aimed_shift) |
                 (aimed_by(p.for_view) << photon_view_shift);
    }
    paths[slot] = PhotonPathRecord(flux.x, flux.y, flux.z, state);
    ledgers[slot] = FluxLedger(uvec4(flux_units(flux, batch.flux_unit), 0u), uvec4(0u), uvec4(0u),
                               uvec4(0u), uvec4(0u));
    active_slots[slot] = slot;
    if ((keeps & kept_light) != 0u) {
        path_lights[slot] = chosen.index;
    }
    if ((keeps & kept_start) != 0u) {
        uint start = is_light(light, light_kinds, light_triangle) ? light.triangle_and_sides / 2u
                                                                  : no_triangle;
        hits[slot] = HitRecord(start, start_of_path, real(0.0), real(0.0));
    }
    if ((keeps & kept_path) != 0u) {
        uint vertex = 2u * (batch.first_path + slot);
        vertices[vertex] = PathVertex(p.origin.x, p.origin.y, p.origin.z, no_vertex);
        path_vertices[slot] = vertex;
    }
}
