#include "cuda/kernel.h"
#include "kernels/flux_sum.twin.h"

namespace argand::twins {
struct flux_sum : flux_sum_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/flux_sum.h"
};
} // namespace argand::twins

ARGAND_TWIN(flux_sum)
