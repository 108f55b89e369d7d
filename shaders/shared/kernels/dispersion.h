// KHR_materials_dispersion: a solid refracts red, green and blue by indices of their own. A path
// that meets one goes on with one of the channels that it still has, which then counts for all of
// them.

// Chooses a channel of what the path carries, and gives the material its index. u: in [0,1).
// Returns among how many channels it chose.
FN real disperse(INOUT(MaterialRecord) m, INOUT(vec3) carried, real u) {
    if (!may_have(m, MATERIAL_DISPERSION) || !(m.dispersion > float32(0.0)) || !is_solid(m)) {
        return real(1.0);
    }
    real red = carried.x > real(0.0) ? real(1.0) : real(0.0);
    real green = carried.y > real(0.0) ? real(1.0) : real(0.0);
    real blue = carried.z > real(0.0) ? real(1.0) : real(0.0);
    real channels = max(red + green + blue, real(1.0));
    real place = u * channels;
    real half_spread = real(m.dispersion) * real(0.025) * (real(m.ior) - real(1.0));
    if (place < red) {
        carried = vec3(carried.x * channels, real(0.0), real(0.0));
        half_spread = -half_spread;
    } else if (place < red + green) {
        carried = vec3(real(0.0), carried.y * channels, real(0.0));
        half_spread = real(0.0);
    } else {
        carried = vec3(real(0.0), real(0.0), carried.z * channels);
    }
    // An index of 0 stays: it reflects all light.
    m.ior = m.ior > float32(0.0) ? float32(max(real(m.ior) + half_spread, real(1.0))) : m.ior;
    return channels;
}
