#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "scene.glsl"
#include "shared/differential_record.h"
#include "shared/light_differential.h"
#include "shared/lights.h"
#include "shared/photon.h"
#include "shared/sampling.h"

layout(set = 0, binding = 7) writeonly buffer Rays { RayRecord rays[]; };
layout(set = 0, binding = 8) writeonly buffer Photons { PhotonPathRecord paths[]; };
layout(set = 0, binding = 9) writeonly buffer Ledgers { FluxLedger ledgers[]; };
layout(set = 0, binding = 10) writeonly buffer Active { uint active_slots[]; };
layout(set = 0, binding = 11) writeonly buffer Differentials { DifferentialRecord differentials[]; };
layout(push_constant) uniform Push { PhotonBatch batch; };

// Whether photons carry differentials.
layout(constant_id = 0) const bool footprints = false;
layout(constant_id = 1) const bool quasi_random = true;

void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.count) {
        return;
    }
    uint photon = batch.first + slot;
    vec4 a = photon_random4(batch.seed, photon, 0u, quasi_random);
    vec4 v = photon_random4(batch.seed, photon, 1u, quasi_random);
    // Emission's and first scattering's directions take one set of jointly well distributed numbers: where the light is
    // small, they decide where the photon is stored.
    vec4 u = vec4(a.x, a.y, v.x, v.y);
    float probability;
    LightRecord light = lights[choose_light(v.w, probability)];
    vec3 origin, direction, normal, flux;
    bool emitted = light_emit(light, u, v.zwxy, scene_center(), scene[0].radius, origin, direction, normal, flux);
    flux = emitted ? flux * (batch.inverse_total / probability) : vec3(0.0);
    if (footprints) {
        float photons = 1.0 / batch.inverse_total;
        differentials[slot] = differential_record(light_differential(
            light, direction, normal, scene[0].radius, photons * probability, photons * batch.emitter_probability));
    }
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, emitted ? far_away : -1.0, direction.x, direction.y, direction.z, 0u);
    paths[slot] = PhotonPathRecord(flux.x, flux.y, flux.z, photon_followed);
    uvec3 units = uvec3(flux_units(flux.x, batch.flux_unit), flux_units(flux.y, batch.flux_unit),
                        flux_units(flux.z, batch.flux_unit));
    ledgers[slot] = FluxLedger(uvec4(units, 0u), uvec4(0u), uvec4(0u), uvec4(0u));
    active_slots[slot] = slot;
}
