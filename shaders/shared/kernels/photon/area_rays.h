#include "shared/kernels/photon/cover_ray.h"

// Writes a short ray to each side of the area samples, against its normal, which finds what lies on
// it: another surface, or the sample's own.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    uint side = params.first + i;
    PhotonRecord place = photons[counters[counter_stored_slots] + side / 2u];
    vec3 front = unpack_photon_normal(place.normal);
    vec3 normal = side % 2u == 0u ? front : -front;
    leave_cover_ray(i, vec3(place.x, place.y, place.z), normal, params.height + params.error);
}
