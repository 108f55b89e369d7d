// Looks up textures at points of triangles.

// Texture coordinates, or a colour, of a vertex.
FN uvec2 vertex_attribute(uint vertex, uint index) {
    return attributes[vertex * scene[0].attributes + index];
}

FN vec2 uv_of(uint vertex, uint set) {
    uvec2 bits = vertex_attribute(vertex, set);
    return vec2(bits_float(bits.x), bits_float(bits.y));
}

FN vec4 texel_color(uint texel, bool srgb) {
    uint red = texel_byte(texel, 0u);
    uint green = texel_byte(texel, 1u);
    uint blue = texel_byte(texel, 2u);
    real alpha = unit_byte(texel_byte(texel, 3u));
    if (srgb) {
        return vec4(bits_float(texels[red]), bits_float(texels[green]), bits_float(texels[blue]),
                    alpha);
    }
    return vec4(unit_byte(red), unit_byte(green), unit_byte(blue), alpha);
}

// b: weights of the triangle's second and third vertex.
FN vec4 sample_texture(uint index, uvec4 triangle, vec2 b) {
    TextureRecord t = textures[index];
    vec2 uv = uv_of(triangle.x, t.uv_set) * (real(1.0) - b.x - b.y) +
              uv_of(triangle.y, t.uv_set) * b.x + uv_of(triangle.z, t.uv_set) * b.y;
    TexelQuad q = texel_quad(t, transform_uv(t, uv));
    bool srgb = (t.flags & texture_srgb) != 0u;
    return interpolate(
        q, texel_color(texels[t.first + q.t00], srgb), texel_color(texels[t.first + q.t10], srgb),
        texel_color(texels[t.first + q.t01], srgb), texel_color(texels[t.first + q.t11], srgb));
}
