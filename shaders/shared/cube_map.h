// Cube maps of the surfaces around centers (Yao et al. 2010, section 3). A texel holds the nearest
// surface in the direction of its middle: the triangle and the distance, as a uvec2. Position,
// normal and material follow from the triangle.
#ifndef ARGAND_SHARED_CUBE_MAP_H
#define ARGAND_SHARED_CUBE_MAP_H

#include "shared/intersect.h"

ARGAND_SHARED_BEGIN

// Texels of a map whose faces have `size` texels a side.
FN uint cube_texels(uint size) { return 6u * size * size; }

FN uint cube_coordinate(real s, uint size) {
    real place = (s + real(1.0)) * real(0.5) * real(size);
    return place > real(0.0) ? min(uint(min(place, real(size))), size - 1u) : 0u; // also of NaN
}

// The texel in a direction of any length but 0. Faces look along +x, -x, +y, -y, +z and -z; columns
// and rows follow the two axes after that one, in cyclic order.
FN uint cube_texel(vec3 direction, uint size) {
    uint axis = longest_axis(direction);
    vec3 d = axis_last(axis, direction);
    uint face = 2u * axis + (d.z < real(0.0) ? 1u : 0u);
    real scale = real(1.0) / abs(d.z);
    return (face * size + cube_coordinate(d.y * scale, size)) * size +
           cube_coordinate(d.x * scale, size);
}

// Turns components along the two axes after `axis`, and along it, into x, y and z.
FN vec3 axis_in_place(uint axis, vec3 v) {
    return axis == 0u ? vec3(v.z, v.x, v.y) : (axis == 1u ? vec3(v.y, v.z, v.x) : v);
}

// Direction of a texel's middle; its component along the face's axis is 1 or -1.
FN vec3 cube_direction(uint texel, uint size) {
    uint face = texel / (size * size);
    real step = real(2.0) / real(size);
    real s = (real(texel % size) + real(0.5)) * step - real(1.0);
    real t = (real(texel / size % size) + real(0.5)) * step - real(1.0);
    return axis_in_place(face / 2u, vec3(s, t, face % 2u == 0u ? real(1.0) : -real(1.0)));
}

// A direction some texels away from another one, along the two axes after that of its face. Beyond
// the edge of a face it lies on the next one.
FN vec3 cube_neighbour(vec3 direction, vec2 texels, uint size) {
    uint axis = longest_axis(direction);
    vec3 d = axis_last(axis, direction);
    real step = abs(d.z) * real(2.0) / real(size);
    return axis_in_place(axis, vec3(d.x + texels.x * step, d.y + texels.y * step, d.z));
}

ARGAND_SHARED_END

#endif
