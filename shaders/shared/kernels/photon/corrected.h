// Whether area samples surround every query at p.
FN bool is_in_corrected_part(IN(vec3) p) {
    vec3 d = p - vec3(params.corrected_x, params.corrected_y, params.corrected_z);
    return dot3(d, d) <= params.corrected_distance * params.corrected_distance;
}

// Whether area samples lie on all surfaces within this distance of p.
FN bool is_in_corrected_part(IN(vec3) p, real reach) {
    vec3 d = p - vec3(params.corrected_x, params.corrected_y, params.corrected_z);
    real inner = params.corrected_distance - reach;
    return inner > real(0.0) && dot3(d, d) <= inner * inner;
}
