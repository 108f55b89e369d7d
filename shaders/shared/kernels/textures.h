// Loads the material at a hit: the texels and the vertices' colours multiply its factors.
#include "shared/kernels/material.h"

// Texture coordinates, or a colour, of a vertex.
FN uvec2 vertex_attribute(uint vertex, uint index) {
    return attributes[vertex * scene[0].attributes + index];
}

FN vec2 uv_of(uint vertex, uint set) {
    uvec2 bits = vertex_attribute(vertex, set);
    return vec2(bits_float(bits.x), bits_float(bits.y));
}

FN vec4 color_of(uint vertex) {
    uvec2 bits = vertex_attribute(vertex, scene[0].color_attribute);
    return vec4(real(bits.x & 0xffffu), real(bits.x >> 16u), real(bits.y & 0xffffu),
                real(bits.y >> 16u)) /
           real(65535.0);
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

FN vec4 sample_texture(uint index, uvec4 triangle, HitRecord hit) {
    TextureRecord t = textures[index];
    vec2 uv = uv_of(triangle.x, t.uv_set) * (real(1.0) - hit.u - hit.v) +
              uv_of(triangle.y, t.uv_set) * hit.u + uv_of(triangle.z, t.uv_set) * hit.v;
    TexelQuad q = texel_quad(t, transform_uv(t, uv));
    bool srgb = (t.flags & texture_srgb) != 0u;
    return interpolate(
        q, texel_color(texels[t.first + q.t00], srgb), texel_color(texels[t.first + q.t10], srgb),
        texel_color(texels[t.first + q.t01], srgb), texel_color(texels[t.first + q.t11], srgb));
}

FN void multiply_base(INOUT(MaterialRecord) m, vec4 color, INOUT(real) alpha) {
    m.base_r *= color.x;
    m.base_g *= color.y;
    m.base_b *= color.z;
    alpha *= color.w;
}

FN MaterialRecord material_at(uvec4 triangle, HitRecord hit) {
    MaterialRecord m = load_material(triangle.w);
    if (!textured && !vertex_colors) {
        return m;
    }
    real alpha = real(1.0);
    uint next = m.textures & material_texture_mask;
    if (textured && (m.textures & material_base_color_texture) != 0u) {
        multiply_base(m, sample_texture(next, triangle, hit), alpha);
        next += 1u;
    }
    if (textured && (m.textures & material_metal_texture) != 0u) {
        vec4 metal = sample_texture(next, triangle, hit);
        m.roughness *= metal.y;
        m.metallic *= metal.z;
    }
    if (vertex_colors && scene[0].color_attribute < scene[0].attributes) {
        multiply_base(m,
                      color_of(triangle.x) * (real(1.0) - hit.u - hit.v) +
                          color_of(triangle.y) * hit.u + color_of(triangle.z) * hit.v,
                      alpha);
    }
    if ((m.textures & material_alpha_blend) != 0u) {
        m.coverage *= alpha;
    } else if ((m.textures & material_alpha_mask) != 0u) {
        m.coverage = alpha >= m.coverage ? real(1.0) : real(0.0);
    }
    return m;
}
