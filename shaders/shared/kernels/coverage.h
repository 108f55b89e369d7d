// Alpha at a point of a triangle, without the rest of its material. Include texel_lookup.h before.

FN real alpha_of_vertex(uint vertex) {
    return real(vertex_attribute(vertex, scene[0].color_attribute).y >> 16u) / real(65535.0);
}

// Share of the surface that is present. triangle: its vertices and material; b: weights of the
// second and third vertex.
FN real coverage_at(uvec4 triangle, vec2 b) {
    uint bits = materials[triangle.w].textures;
    real coverage = real(materials[triangle.w].coverage);
    if ((bits & (material_alpha_blend | material_alpha_mask)) == 0u) {
        return coverage;
    }
    real alpha = real(1.0);
    if (textured && (bits & material_base_color_texture) != 0u) {
        alpha = sample_texture(bits & material_texture_mask, triangle, b).w;
    }
    if (vertex_colors && scene[0].color_attribute < scene[0].attributes) {
        alpha *= alpha_of_vertex(triangle.x) * (real(1.0) - b.x - b.y) +
                 alpha_of_vertex(triangle.y) * b.x + alpha_of_vertex(triangle.z) * b.y;
    }
    if ((bits & material_alpha_mask) != 0u) {
        return alpha >= coverage ? real(1.0) : real(0.0);
    }
    return coverage * alpha;
}

// Whether nothing is there. What emits is there even without coverage, for its alpha does not scale
// the emission.
FN bool is_absent(uvec4 triangle, real coverage) {
    MaterialRecord m = materials[triangle.w];
    return !(coverage > real(0.0)) &&
           ((m.textures & material_alpha_mask) != 0u ||
            !(max(m.emission_r, max(m.emission_g, m.emission_b)) > float32(0.0)));
}
