// Lights that are triangles with textures. Include texels.h before.
#include "shared/kernels/coverage.h"

FN uint emissive_texture_of(uint material_textures) {
    return (material_textures & material_texture_mask) +
           ((material_textures & material_base_color_texture) != 0u ? 1u : 0u) +
           ((material_textures & material_metal_texture) != 0u ? 1u : 0u);
}

// Whether a light is a triangle that shines by its texels.
FN bool shines_by_texels(IN(LightRecord) light) {
    return emissive_texels && is_light(light, light_kinds, light_triangle) &&
           light.cos_inner > real(0.0);
}

// Chooses a point on such a light by its texels: warps the two numbers that choose it, and sets the
// light's radiance to that of the point over the density of such points. Returns this density, over
// that of points that are spread evenly.
FN real choose_texel(INOUT(LightRecord) light, INOUT(vec2) u) {
    TexelNumbers n = begin_texels(u);
    uint at = uint(light.cos_inner);
    for (uint level = 0u; level < most_texel_levels && texels[at] != 0u; ++level) {
        bool upper = descend_by_share(texels[at] & 1u, bits_float(texels[at + 1u]), n);
        at = (texels[at] >> 1u) + (upper ? words_of_texel_node : 0u);
    }
    u = end_texels(n);
    uvec4 triangle = triangles[triangle_of_light(light)];
    MaterialRecord m = materials[triangle.w];
    vec4 texel = sample_texture(emissive_texture_of(m.textures), triangle, sample_triangle(u));
    light.r = m.emission_r * texel.x / n.density;
    light.g = m.emission_g * texel.y / n.density;
    light.b = m.emission_b * texel.z / n.density;
    return n.density;
}

// The density with which choose_texel() chooses this point.
FN real density_by_texels(IN(LightRecord) light, real b1, real b2) {
    TexelNumbers n = begin_texels(numbers_of_point(b1, b2));
    uint at = uint(light.cos_inner);
    for (uint level = 0u; level < most_texel_levels && texels[at] != 0u; ++level) {
        bool upper = descend_by_place(texels[at] & 1u, bits_float(texels[at + 1u]), n);
        at = (texels[at] >> 1u) + (upper ? words_of_texel_node : 0u);
    }
    return n.density;
}

// Whether a mask leaves out the point that these numbers choose on a light.
FN bool is_masked_out(IN(LightRecord) light, vec2 u) {
    if (!(textured || vertex_colors) || !is_light(light, light_kinds, light_triangle)) {
        return false;
    }
    uvec4 triangle = triangles[triangle_of_light(light)];
    return (materials[triangle.w].textures & material_alpha_mask) != 0u &&
           !(coverage_at(triangle, sample_triangle(u)) > real(0.0));
}
