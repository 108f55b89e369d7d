#include "cuda/kernel.h"
#include "kernels/photon_count.twin.h"

namespace argand::twins {
struct photon_count : photon_count_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_count.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_count)
