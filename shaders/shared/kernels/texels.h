// Lookup of textures at points of triangles.
#include "shared/kernels/texel_lookup.h"

FN vec4 mip_color(uint at) { return texel_of_mip(texels[at], texels[at + 1u]); }

// Interpolates in one of a texture's levels above the image.
FN vec4 sample_mip(TextureRecord t, vec2 uv, uint level) {
    uint first = t.first + words_before_mip(t.width, t.height, level);
    t.width = mip_size(t.width, level);
    t.height = mip_size(t.height, level);
    TexelQuad q = texel_quad(t, uv);
    return interpolate(
        q, mip_color(first + words_of_mip * q.t00), mip_color(first + words_of_mip * q.t10),
        mip_color(first + words_of_mip * q.t01), mip_color(first + words_of_mip * q.t11));
}

// As sample_texture, but between two mip levels where a path stands for more than a texel. Only
// for colours by which reflected light is multiplied: the mean of a roughness reflects other light
// than the roughnesses. width: of the cone at the hit; direction: of the ray.
FN vec4 sample_filtered(uint index, uvec4 triangle, vec2 b, real width, vec3 direction) {
    TextureRecord t = textures[index];
    if (!mip_maps || (t.flags & texture_mips) == 0u || !(width > real(0.0))) {
        return sample_texture(index, triangle, b);
    }
    vec2 uv0 = uv_of(triangle.x, t.uv_set);
    vec2 uv1 = uv_of(triangle.y, t.uv_set);
    vec2 uv2 = uv_of(triangle.z, t.uv_set);
    vec2 along1 = transform_uv(t, uv1) - transform_uv(t, uv0);
    vec2 along2 = transform_uv(t, uv2) - transform_uv(t, uv0);
    vec3 edge1 = vec3(positions[triangle.y]) - vec3(positions[triangle.x]);
    vec3 edge2 = vec3(positions[triangle.z]) - vec3(positions[triangle.x]);
    real world_area;
    vec3 normal = unit_and_length(cross3(edge1, edge2), world_area);
    real level = mip_level(t, abs(along1.x * along2.y - along1.y * along2.x), world_area, width,
                           dot3(normal, direction));
    uint below = uint(level);
    vec2 uv = transform_uv(t, uv0 * (real(1.0) - b.x - b.y) + uv1 * b.x + uv2 * b.y);
    vec4 color;
    if (below == 0u) {
        color = sample_texture(index, triangle, b);
    } else {
        color = sample_mip(t, uv, below);
    }
    real share = level - real(below);
    if (share > real(0.0)) {
        color += (sample_mip(t, uv, below + 1u) - color) * share;
    }
    return color;
}
