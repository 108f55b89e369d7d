// Absorption inside solids. A ray carries the solid that it is in, so that light is absorbed on its
// way to what lies inside as well: 1 more than the index of its material, or 0 for none. Rays of
// paths have no end: RayRecord::t_max has room for this, just below far_away or, where they go on
// behind their last hit, just above goes_on.
//
// A ray that leaves a solid is taken to be in none, and one that meets a surface from inside while
// it is in none, to have been in that solid. So it is right for solids apart from each other, and
// for one within another.

FN real unbounded_in(uint medium) { return bits_float(float_bits(far_away) - medium); }
FN real goes_on_in(uint medium) { return bits_float(float_bits(goes_on) + medium); }
FN uint medium_of(float32 t_max) {
    return t_max > far_away ? float_bits(t_max) - float_bits(goes_on)
                            : float_bits(far_away) - float_bits(t_max);
}

// The solid in which a ray reached a surface. known: medium_of its ray; material: the surface's.
FN uint medium_before(uint known, uint material, IN(MaterialRecord) m, bool front) {
    if (!may_have(m, MATERIAL_ABSORPTION)) {
        return 0u;
    }
    return known == 0u && !front && is_solid(m) ? material + 1u : known;
}

// The solid in which a path goes on. before: the one in which it came; passes: to the other side.
FN uint medium_after(uint before, uint material, IN(MaterialRecord) m, bool front, bool passes) {
    if (!may_have(m, MATERIAL_ABSORPTION) || !passes || !is_solid(m)) {
        return before;
    }
    return front ? material + 1u : 0u;
}

// Part of the light that a solid lets through over a distance (Beer and Lambert).
FN vec3 transmittance(uint medium, real distance) {
    if (medium == 0u) {
        return vec3(real(1.0));
    }
    MaterialRecord m = materials[medium - 1u];
    return vec3(exp_negative(-m.absorption_r * distance), exp_negative(-m.absorption_g * distance),
                exp_negative(-m.absorption_b * distance));
}
