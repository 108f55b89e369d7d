#include "cuda/kernel.h"
#include "kernels/footprint_gather.twin.h"

namespace argand::twins {
struct footprint_gather : footprint_gather_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/footprint_gather.h"
};
} // namespace argand::twins

ARGAND_TWIN(footprint_gather)
