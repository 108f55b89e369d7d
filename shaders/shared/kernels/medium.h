// The solids that a path is in: light is absorbed on its way through them, and refracted by the
// index of refraction on either side of an interface. A ray carries them as a set (solids.h). Rays
// of paths have no end: RayRecord::t_max has room for the set, just below far_away or, where they
// go on behind their last hit, just above goes_on.
//
// Paths start in no solid, as far as they know. One that meets a solid's surface from inside has
// been in it. So a camera or a lamp inside a solid is right up to the first surface of another one.

#include "shared/solids.h"

// Index of the material of a rank.
FN uint solid_of_rank(uint rank) { return materials[rank].solids >> solid_of_rank_shift; }

FN real unbounded_in(uint solids) { return bits_float(float_bits(far_away) - solids); }
FN real goes_on_in(uint solids) { return bits_float(float_bits(goes_on) + solids); }
FN uint solids_of(float32 t_max) {
    return t_max > far_away ? float_bits(t_max) - float_bits(goes_on)
                            : float_bits(far_away) - float_bits(t_max);
}

// The solids in which a ray reached a surface. known: solids_of its ray.
FN uint solids_on_way(uint known, IN(MaterialRecord) m, bool front) {
    if (!may_have(m, MATERIAL_ABSORPTION | MATERIAL_NESTED)) {
        return 0u;
    }
    return is_solid(m) ? solids_before(known, solid_bit(m), front) : known;
}

// The solids in which a path goes on. before: those in which it came; passes: to the other side.
FN uint solids_after(uint before, IN(MaterialRecord) m, bool front, bool passes) {
    if (!may_have(m, MATERIAL_ABSORPTION | MATERIAL_NESTED) || !passes || !is_solid(m)) {
        return before;
    }
    return solids_behind(before, solid_bit(m), front);
}

// t_max of a ray that goes on behind a surface that is not there. A hidden one leads into the
// solid or out of it. t_max: of the ray that met it.
FN real goes_on_past(float32 t_max, uint before, IN(MaterialRecord) m, bool front, bool hidden) {
    return goes_on_in(hidden ? solids_behind(before, solid_bit(m), front) : solids_of(t_max));
}

// Whether the surface is not there, as it lies inside a solid of higher rank.
FN bool is_hidden(uint before, IN(MaterialRecord) m) {
    return may_have(m, MATERIAL_NESTED) && is_solid(m) && is_in_higher_solid(before, solid_bit(m));
}

// Refers the solid's index of refraction to what lies around it.
FN void refer_index(uint before, INOUT(MaterialRecord) m) {
    if (!may_have(m, MATERIAL_NESTED) || !is_solid(m)) {
        return;
    }
    uint around = before & ~solid_bit(m);
    if (around != 0u) {
        uint other = solid_of_rank(highest_solid(around));
        m.ior = float32(relative_ior(real(m.ior), real(materials[other].ior)));
    }
}

// Part of the light that is left after a distance in a solid (Beer and Lambert).
FN vec3 transmittance_of(IN(MaterialRecord) m, real distance) {
    return vec3(exp_negative(-m.absorption_r * distance), exp_negative(-m.absorption_g * distance),
                exp_negative(-m.absorption_b * distance));
}

// The same in a set of solids.
FN vec3 transmittance(uint solids, real distance) {
    if (solids == 0u) {
        return vec3(real(1.0));
    }
    return transmittance_of(materials[solid_of_rank(highest_solid(solids))], distance);
}

// The same on the way to a surface. before: solids_on_way.
FN vec3 transmittance_to(uint before, IN(MaterialRecord) m, bool front, real distance) {
    bool inside_unranked = !front && is_solid(m) && solid_bit(m) == 0u;
    return inside_unranked ? transmittance_of(m, distance) : transmittance(before, distance);
}
