// Share of the light that a shadow ray brings. Needs a buffer `occluded`.
FN real passed_light(uint slot) {
    if (has_alpha) {
        return transmittance(occluded[slot]);
    }
    return occluded[slot] != 0u ? real(0.0) : real(1.0);
}
