// Emissive triangles as lights.
#ifndef ARGAND_SHARED_EMISSIVE_H
#define ARGAND_SHARED_EMISSIVE_H

#include "shared/emissive_records.h"
#include "shared/lights.h"
#include "shared/material_record.h"

ARGAND_SHARED_BEGIN

// The light that a triangle of the scene is, by its vertices and its material.
FN LightRecord emissive_light(uint triangle, vec3 a, vec3 b, vec3 c, IN(MaterialRecord) m) {
    LightRecord l;
    l.x = a.x;
    l.y = a.y;
    l.z = a.z;
    l.kind = light_triangle;
    l.r = m.emission_r;
    l.g = m.emission_g;
    l.b = m.emission_b;
    l.cos_inner = real(0.0);
    l.dx = b.x;
    l.dy = b.y;
    l.dz = b.z;
    l.cos_outer = real(0.0);
    l.ex = c.x;
    l.ey = c.y;
    l.ez = c.z;
    l.triangle_and_sides = 2u * triangle + (m.double_sided != 0u ? 1u : 0u);
    return l;
}

// Makes a triangle's light one that shines by texels.
FN void shine_by_texels(INOUT(LightRecord) l, IN(TexelMean) texels) {
    l.r *= texels.r;
    l.g *= texels.g;
    l.b *= texels.b;
    l.cos_inner = real(texels.root);
}

ARGAND_SHARED_END

#endif
