// Loads the material at a hit: the texels and the vertices' colours multiply its factors.
#include "shared/kernels/material.h"
#include "shared/kernels/texels.h"

FN vec4 color_of(uint vertex) {
    uvec2 bits = vertex_attribute(vertex, scene[0].color_attribute);
    return vec4(real(bits.x & 0xffffu), real(bits.x >> 16u), real(bits.y & 0xffffu),
                real(bits.y >> 16u)) /
           real(65535.0);
}

FN void multiply_base(INOUT(MaterialRecord) m, vec4 color, INOUT(real) alpha) {
    m.base_r *= color.x;
    m.base_g *= color.y;
    m.base_b *= color.z;
    alpha *= color.w;
}

// Turns the direction by the texel's, as complex numbers do.
FN void multiply_anisotropy(INOUT(MaterialRecord) m, vec4 texel) {
    vec2 turn =
        unit_direction(vec2(real(2.0) * texel.x - real(1.0), real(2.0) * texel.y - real(1.0)));
    real x = real(m.anisotropy_x);
    real y = real(m.anisotropy_y);
    m.anisotropy_x = float32((x * turn.x - y * turn.y) * texel.z);
    m.anisotropy_y = float32((x * turn.y + y * turn.x) * texel.z);
}

// The textures of `material_other_textures`. next: index of the first.
FN void multiply_others(INOUT(MaterialRecord) m, uint next, uvec4 triangle, vec2 b) {
    for (uint i = 0u; i < most_other_textures; ++i) {
        vec4 texel = sample_texture(next + i, triangle, b);
        uint flags = textures[next + i].flags;
        uint use = (flags >> texture_use_shift) & texture_use_mask;
        if (use == texture_of_specular) {
            m.specular *= texel.w;
        } else if (use == texture_of_specular_color) {
            m.specular_r *= texel.x;
            m.specular_g *= texel.y;
            m.specular_b *= texel.z;
        } else if (use == texture_of_transmission) {
            m.transmission *= texel.x;
        } else if (use == texture_of_thickness) {
            m.thickness *= texel.y;
        } else if (use == texture_of_coat) {
            m.coat *= texel.x;
        } else if (use == texture_of_coat_roughness) {
            m.coat_roughness *= texel.y;
        } else if (use == texture_of_coat_normal) {
            vec3 slope = slope_of_texel(texel, real(textures[next + i].scale));
            m.coat_normal_x = float32(slope.x);
            m.coat_normal_y = float32(slope.y);
            m.coat_normal_z = float32(max(slope.z, real(1.0 / 127.0)));
        } else if (use == texture_of_film) {
            m.film *= texel.x;
        } else if (use == texture_of_sheen_color) {
            m.sheen_r *= texel.x;
            m.sheen_g *= texel.y;
            m.sheen_b *= texel.z;
        } else if (use == texture_of_sheen_roughness) {
            m.sheen_roughness *= texel.w;
        } else if (use == texture_of_anisotropy) {
            multiply_anisotropy(m, texel);
        } else if (use == texture_of_film_thickness) {
            real least = real(textures[next + i].scale);
            m.film_thickness *= least + (real(1.0) - least) * texel.y;
        }
        if ((flags & texture_last) != 0u) {
            break;
        }
    }
}

// cone, direction: of the ray that hit the surface.
FN MaterialRecord material_at(uvec4 triangle, HitRecord hit, uint cone, vec3 direction) {
    MaterialRecord m = load_material(triangle.w);
    if (!textured && !vertex_colors) {
        return m;
    }
    real alpha = real(1.0);
    vec2 b = vec2(hit.u, hit.v);
    uint next = m.textures & material_texture_mask;
    if (textured && (m.textures & material_base_color_texture) != 0u) {
        real width = mip_maps ? cone_width(cone, real(hit.t)) : real(0.0);
        multiply_base(m, sample_filtered(next, triangle, b, width, direction), alpha);
        next += 1u;
    }
    if (textured && (m.textures & material_metal_texture) != 0u) {
        vec4 metal = sample_texture(next, triangle, b);
        m.roughness *= metal.y;
        m.metallic *= metal.z;
        next += 1u;
    }
    if (textured && (m.textures & material_emissive_texture) != 0u) {
        if (emissive_texels) {
            vec4 emission = sample_texture(next, triangle, b);
            m.emission_r *= emission.x;
            m.emission_g *= emission.y;
            m.emission_b *= emission.z;
        }
        next += 1u;
    }
    if (other_textures && (m.textures & material_other_textures) != 0u) {
        next += (m.textures & material_normal_texture) != 0u ? 1u : 0u;
        multiply_others(m, next, triangle, b);
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
        m.coverage = real(1.0); // rays pass it elsewhere (kernels/coverage.h)
    }
    return m;
}
