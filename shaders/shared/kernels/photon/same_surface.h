// Which points of the map lie on one surface.

// Whether both ends of a chord do, on one side of it. normal: at the chord's beginning; at the end,
// its packed normal is `packed`, and the opposite one counts with `opposite`. expected: what
// `packed` is where both normals are equal. rounding: of heights over the tangent plane, by the
// positions' single precision.
FN bool are_on_one_surface(vec3 normal, uint expected, uint packed, bool opposite, real rounding,
                           vec3 chord) {
    real height = dot3(chord, normal);
    real length2 = dot3(chord, chord);
    if (height * height > steepest_chord * length2) {
        return false; // before the normal is unpacked
    }
    real along_sum = height + height;
    real tolerance2 = flat_tolerance * flat_tolerance;
    // On flat surfaces the packed normals are equal, which saves unpacking.
    if ((packed & photon_normal_mask) != expected) {
        vec3 there = unpack_photon_normal(packed);
        there = opposite ? -there : there;
        along_sum = height + dot3(chord, there);
        if (!(dot3(there, normal) >= same_surface_cosine)) {
            return false;
        }
        vec3 turned = there - normal;
        tolerance2 = min(tolerance2 + dot3(turned, turned), chord_tolerance * chord_tolerance);
    }
    real excess = max(abs(along_sum) - rounding, real(0.0));
    return excess * excess <= tolerance2 * length2;
}
