// Lookup of textures, as glTF 2.0 and OpenGL define it: repeated, mirrored or clamped coordinates,
// the nearest texel or bilinear interpolation. Kernels read the texels (kernels/textures.h).
#ifndef ARGAND_SHARED_TEXTURE_H
#define ARGAND_SHARED_TEXTURE_H

#include "shared/maths.h"
#include "shared/texture_record.h"

ARGAND_SHARED_BEGIN

// The four texels around a point, as indices within the image, and the weights of the second column
// and of the second row.
struct TexelQuad {
    uint t00, t10, t01, t11;
    real x, y;
};

// 0 where the product overflows: such coordinates have no meaning.
FN vec2 transform_uv(IN(TextureRecord) t, vec2 uv) {
    real u = real(t.uu) * uv.x + real(t.uv) * uv.y + real(t.u0);
    real v = real(t.vu) * uv.x + real(t.vv) * uv.y + real(t.v0);
    return vec2(is_finite(u) ? u : real(0.0), is_finite(v) ? v : real(0.0));
}

// The place in [0,1] of the image that a coordinate shows.
FN real wrap_coordinate(real t, uint wrap) {
    if (wrap == texture_clamp) {
        return clamp(t, real(0.0), real(1.0));
    }
    if (wrap == texture_mirror) {
        real in_period = t - real(2.0) * floor(real(0.5) * t);
        return in_period > real(1.0) ? real(2.0) - in_period : in_period;
    }
    return t - floor(t);
}

// Index of a texel of a row or column; i: from -1 to size.
FN uint wrap_texel(int i, uint size, uint wrap) {
    if (i < 0) {
        return wrap == texture_repeat ? size - 1u : 0u;
    }
    if (uint(i) >= size) {
        return wrap == texture_repeat ? 0u : size - 1u;
    }
    return uint(i);
}

// The texels at place p in [0,1] of a row or column: the first, the second, and the second's
// weight.
FN real texel_pair(real p, uint size, uint wrap, bool nearest, OUT(uint) a, OUT(uint) b) {
    real at = p * real(size);
    if (nearest) {
        a = min(uint(at), size - 1u);
        b = a;
        return real(0.0);
    }
    real shifted = at - real(0.5);
    real below = floor(shifted);
    a = wrap_texel(int(below), size, wrap);
    b = wrap_texel(int(below) + 1, size, wrap);
    return shifted - below;
}

// uv: finite, after transform_uv().
FN TexelQuad texel_quad(IN(TextureRecord) t, vec2 uv) {
    uint wrap_u = t.flags & texture_wrap_mask;
    uint wrap_v = (t.flags >> texture_wrap_v) & texture_wrap_mask;
    bool nearest = (t.flags & texture_nearest) != 0u;
    uint left;
    uint right;
    uint top;
    uint bottom;
    TexelQuad q;
    q.x = texel_pair(wrap_coordinate(uv.x, wrap_u), t.width, wrap_u, nearest, left, right);
    q.y = texel_pair(wrap_coordinate(uv.y, wrap_v), t.height, wrap_v, nearest, top, bottom);
    q.t00 = top * t.width + left;
    q.t10 = top * t.width + right;
    q.t01 = bottom * t.width + left;
    q.t11 = bottom * t.width + right;
    return q;
}

FN vec4 interpolate(IN(TexelQuad) q, vec4 c00, vec4 c10, vec4 c01, vec4 c11) {
    vec4 top = c00 + (c10 - c00) * q.x;
    vec4 bottom = c01 + (c11 - c01) * q.x;
    return top + (bottom - top) * q.y;
}

// One of the four bytes of a texel, red is the lowest.
FN uint texel_byte(uint texel, uint channel) { return (texel >> (8u * channel)) & 0xffu; }

FN real unit_byte(uint code) { return real(code) / real(255.0); }

// Mip levels. Level k has floor(size / 2^k) columns and rows, but at least one. Each of its texels
// is the mean of its part of the image, so that all levels have the same mean. They follow the
// image in two words per texel: the square roots of linear red, green and blue, in 16 bits each,
// and alpha. (A mean in eight bits would be wrong by half a percent.)
CONSTANT uint words_of_mip = 2u;

FN uint mip_size(uint size, uint level) { return max(size >> level, 1u); }

// The highest level, of one texel.
FN uint last_mip(uint width, uint height) { return uint(findMSB(max(width, height))); }

// Words between a texture's first texel and those of a level, which is at least 1.
FN uint words_before_mip(uint width, uint height, uint level) {
    uint words = width * height;
    for (uint k = 1u; k < level; ++k) {
        words += words_of_mip * mip_size(width, k) * mip_size(height, k);
    }
    return words;
}

FN real mip_code(uint code) {
    real root = real(code) / real(65535.0);
    return root * root;
}

FN vec4 texel_of_mip(uint first, uint second) {
    return vec4(mip_code(first & 0xffffu), mip_code(first >> 16u), mip_code(second & 0xffffu),
                real(second >> 16u) / real(65535.0));
}

// Logarithm to base 2 of a finite number of at least 1, between powers of two by a straight line:
// off by at most 0.09, and the same on every device.
FN real rough_log2(real x) {
    uint bits = float_bits(float32(x));
    real mantissa = real(bits_float((bits & 0x007fffffu) | 0x3f800000u));
    return real(int(bits >> 23u) - 128) + mantissa;
}

// The mip level of a lookup that a cone of this width makes: 0 where a texel is as wide. uv_area:
// of the triangle in the image; world_area: its own; cosine: between the ray and the normal.
FN real mip_level(IN(TextureRecord) t, real uv_area, real world_area, real width, real cosine) {
    real texels = uv_area * real(t.width) * real(t.height) / world_area;
    real squared = texels * width * width / max(abs(cosine), real(1e-3));
    if (!(squared > real(1.0))) {
        return real(0.0);
    }
    real most = real(last_mip(t.width, t.height));
    // Triangles without area show one point, in any level.
    return is_finite(squared) ? min(real(0.5) * rough_log2(squared), most) : most;
}

ARGAND_SHARED_END

#endif
