#include "shared/kernels/photon/corrected.h"
#include "shared/kernels/photon/cover_ray.h"

// Writes a short ray to each photon, against its surface's normal, which ends before the surface
// and finds what covers it. Caustic photons keep their sharp light wherever they lie.
FN void main() {
    uint i = THREAD_INDEX;
    if (i >= params.count) {
        return;
    }
    PhotonRecord p = photons[params.first + i];
    vec3 place = vec3(p.x, p.y, p.z);
    bool tested =
        p.normal != no_photon && !photon_is_caustic(p.normal) && is_in_corrected_part(place);
    leave_cover_ray(i, place, unpack_photon_normal(p.normal),
                    tested ? params.height - params.error : -real(1.0));
}
