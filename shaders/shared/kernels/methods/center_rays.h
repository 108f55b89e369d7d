#include "shared/kernels/pixel.h"

// The ray through the middle of each pixel of a batch and the middle of the lens. Its direction has
// length 1 along the camera's axis, so that hits are at their depth.
FN void main() {
    uint slot = THREAD_INDEX;
    if (slot >= batch.pixels) {
        return;
    }
    uint pixel = pixel_in_image(batch.first_pixel + slot);
    uint column = pixel % batch.width;
    uint row = pixel / batch.width;
    vec3 origin, direction;
    pinhole_ray(camera[0], real(column) + real(0.5), real(row) + real(0.5), origin, direction);
    rays[slot] = RayRecord(origin.x, origin.y, origin.z, far_away, direction.x, direction.y,
                           direction.z, 0u);
    active_slots[slot] = slot;
}
