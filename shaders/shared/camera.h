#ifndef ARGAND_SHARED_CAMERA_H
#define ARGAND_SHARED_CAMERA_H

#include "shared/frame.h"

ARGAND_SHARED_BEGIN

// A camera for one image size. A point of the image, x and y pixels from the top left corner, lies
// at x·across + y·down from that corner. Perspective: rays start at `origin`, and `forward` leads
// from there to the corner, on the plane at distance 1. Orthographic: rays start on the image
// plane, whose corner is `origin`, and go along `forward`. Laid out in 16-byte lanes.
//
// The thin lens is a disc around the pinhole, perpendicular to the camera's axis. All rays through
// a point of the image meet at one distance along the axis, where the image is sharp.
struct CameraRecord {
    float32 origin_x, origin_y, origin_z;
    float32 origin_share; // 0: perspective, 1: orthographic
    float32 forward_x, forward_y, forward_z;
    float32 lens_radius;                  // 0: a pinhole
    float32 across_x, across_y, across_z; // from one pixel to the next in a row
    float32 inverse_focus;                // 1 / the distance at which the image is sharp
    float32 down_x, down_y, down_z, pad;  // from one row to the next
};

// The ray through (x, y) and the pinhole, with a direction of length 1 along the camera's axis.
FN void pinhole_ray(IN(CameraRecord) c, real x, real y, OUT(vec3) origin, OUT(vec3) direction) {
    vec3 in_picture =
        vec3(c.across_x, c.across_y, c.across_z) * x + vec3(c.down_x, c.down_y, c.down_z) * y;
    real share = real(c.origin_share);
    origin = vec3(c.origin_x, c.origin_y, c.origin_z) + in_picture * share;
    direction = vec3(c.forward_x, c.forward_y, c.forward_z) + in_picture * (real(1.0) - share);
}

// The ray through (x, y), in pixels from the image's top left corner, and through the point of the
// lens that u in [0, 1)² stands for. direction: unit.
FN void camera_ray(IN(CameraRecord) c, real x, real y, vec2 u, OUT(vec3) origin,
                   OUT(vec3) direction) {
    vec3 d;
    pinhole_ray(c, x, y, origin, d);
    if (c.lens_radius > 0.0f) {
        vec2 on_lens = sample_disc(u) * real(c.lens_radius);
        vec3 across = vec3(c.across_x, c.across_y, c.across_z);
        vec3 down = vec3(c.down_x, c.down_y, c.down_z);
        vec3 offset = across * (on_lens.x / sqrt(dot3(across, across))) +
                      down * (on_lens.y / sqrt(dot3(down, down)));
        origin = origin + offset;
        d = d - offset * real(c.inverse_focus);
    }
    direction = d / sqrt(dot3(d, d)); // at least 1 along the camera's axis
}

ARGAND_SHARED_END

#endif
