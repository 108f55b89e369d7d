#include "shared/kernels/scene.h"

FN void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.count) {
        return;
    }
    uint photon = batch.first + slot;
    vec4 a = photon_random4(batch.seed, photon, 0u, quasi_random);
    vec4 v = photon_random4(batch.seed, photon, 1u, quasi_random);
    // The directions of emission and of the first scattering use one set of jointly well
    // distributed numbers: if the light is small, they determine where the photon is stored.
    vec4 u = vec4(a.x, a.y, v.x, v.y);
    real probability;
    LightRecord light = lights[choose_light(v.w, probability)];
    Sphere bounds;
    bounds.center = scene_center();
    bounds.radius = scene[0].radius;
    EmittedPhoton p;
    bool emitted = light_emit(light, light_kinds, bounds, u, vec4(v.z, v.w, v.x, v.y), p);
    vec3 flux = emitted ? p.flux * (batch.inverse_total / probability) : vec3(real(0.0));
    if (footprints) {
        real photons = real(1.0) / batch.inverse_total;
        differentials[slot] = differential_record(
            light_differential(light, light_kinds, p, scene[0].radius, photons * probability,
                               photons * scene[0].emitter_probability));
    }
    rays[slot] = RayRecord(p.origin.x, p.origin.y, p.origin.z, emitted ? far_away : -real(1.0),
                           p.direction.x, p.direction.y, p.direction.z, 0u);
    paths[slot] = PhotonPathRecord(flux.x, flux.y, flux.z, photon_followed);
    ledgers[slot] =
        FluxLedger(uvec4(flux_units(flux, batch.flux_unit), 0u), uvec4(0u), uvec4(0u), uvec4(0u));
    active_slots[slot] = slot;
}
