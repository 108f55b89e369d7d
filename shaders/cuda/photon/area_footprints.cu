#include "cuda/kernel.h"
#include "kernels/area_footprints.twin.h"

namespace argand::twins {
struct area_footprints : area_footprints_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/area_footprints.h"
};
} // namespace argand::twins

ARGAND_TWIN(area_footprints)
