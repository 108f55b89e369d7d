#include "cuda/kernel.h"
#include "kernels/photon_leaves.twin.h"

namespace argand::twins {
struct photon_leaves : photon_leaves_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_leaves.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_leaves)
