#include "cuda/kernel.h"
#include "kernels/photon_gather.twin.h"

namespace argand::twins {
struct photon_gather : photon_gather_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_gather.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_gather)
