#include "cuda/kernel.h"
#include "kernels/photon_footprints.twin.h"

namespace argand::twins {
struct photon_footprints : photon_footprints_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_footprints.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_footprints)
