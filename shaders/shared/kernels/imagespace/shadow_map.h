// The maps around a point light as its shadow map (Yao et al. 2010, section 7). The kernel declares
//   uint thickness_at(uint triangle, vec2 b)
// of the surface at a point of a triangle (shared/alpha.h).

// Where light arrives, relative to the center.
struct Receiver {
    vec3 place;
    real distance; // from the center
    vec3 normal;   // of the triangle
    uint triangle;
};

// How far the receiver's plane is in a direction near that of the receiver; where light grazes it
// and the plane tells nothing, as far as the receiver.
FN real plane_distance(IN(Receiver) at, vec3 direction) {
    real along = dot3(at.normal, at.place) / dot3(at.normal, direction);
    return along >= real(0.5) * at.distance && along <= real(2.0) * at.distance ? along
                                                                                : at.distance;
}

// Share of the light that passes what the layers of one texel show before the receiver's plane.
FN real light_through_texel(uint center, uint texel, IN(Receiver) at) {
    real extent;
    vec3 direction = unit_and_length(cube_direction(texel, params.size), extent);
    real nearest = (real(1.0) - depth_error) * plane_distance(at, direction);
    uint thickness = 0u;
    for (uint layer = 0u; layer < params.layers; ++layer) {
        uvec2 texel_of_layer =
            map_texels[(center * params.layers + layer) * cube_texels(params.size) + texel];
        if (texel_of_layer.x == no_triangle || texel_of_layer.x == at.triangle ||
            bits_float(texel_of_layer.y) >= nearest) {
            continue;
        }
        uvec4 t = triangles[texel_of_layer.x];
        vec3 from = vec3(centers[center]);
        vec2 b = weights_toward(direction, vec3(positions[t.x]) - from, vec3(positions[t.y]) - from,
                                vec3(positions[t.z]) - from);
        thickness = add_thickness(thickness, thickness_at(texel_of_layer.x, b));
    }
    return transmittance(thickness);
}

// Percentage-closer filtering (Reeves et al. 1987): what the four texels around the receiver's
// direction let pass, by how near their middles are.
FN real light_through_map(uint center, IN(Receiver) at) {
    vec3 on_face = axis_last(longest_axis(at.place), at.place);
    real scale = real(0.5) * real(params.size);
    real x = on_face.x / abs(on_face.z) * scale + (scale + real(0.5));
    real y = on_face.y / abs(on_face.z) * scale + (scale + real(0.5));
    vec2 upper = vec2(x - floor(x), y - floor(y));
    real passed = real(0.0);
    for (uint i = 0u; i < 4u; ++i) {
        bool right = (i & 1u) != 0u;
        bool above = (i & 2u) != 0u;
        vec2 step = vec2(right ? real(0.5) : -real(0.5), above ? real(0.5) : -real(0.5));
        uint texel = cube_texel(cube_neighbour(at.place, step, params.size), params.size);
        passed += (right ? upper.x : real(1.0) - upper.x) *
                  (above ? upper.y : real(1.0) - upper.y) * light_through_texel(center, texel, at);
    }
    return min(passed, real(1.0));
}
