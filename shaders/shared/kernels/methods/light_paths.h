// Densities of shared/light_path.h in this scene.
#include "shared/kernels/targets.h"

FN real probability_for_photons(uint light) {
    return several_lights ? light_choices[scene[0].light_count + light].probability : real(1.0);
}

FN real probability_for_shadow_rays(uint light) {
    return several_lights ? light_choices[light].probability : real(1.0);
}

// density_of_photons() of a light. photons: of all lights.
FN real density_of_light(uint index, IN(LightRecord) light, real photons, vec3 origin,
                         vec3 direction, real distance, real sky_pdf) {
    return density_of_photons(light, light_kinds, scene_targets(), real(scene[0].radius),
                              photons * probability_for_photons(index), origin, direction, distance,
                              sky_pdf);
}
