// The cone of one of a pixel's paths, of which there are `samples`.
FN uint camera_cone(CameraRecord c, vec3 direction, real samples) {
    vec3 across = vec3(c.across_x, c.across_y, c.across_z);
    vec3 axis = cross3(across, vec3(c.down_x, c.down_y, c.down_z)); // a pixel's area along the axis
    real area;
    vec3 unit = unit_and_length(axis, area);
    // On the plane at distance 1 a pixel is as large as in the picture; rays to it are longer.
    real width = sqrt(area / samples);
    real share = real(c.origin_share);
    return pack_cone(width * share, width * (real(1.0) - share) * abs(dot3(unit, direction)));
}
