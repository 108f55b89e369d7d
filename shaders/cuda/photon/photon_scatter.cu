#include "cuda/kernel.h"
#include "kernels/photon_scatter.twin.h"

namespace argand::twins {
struct photon_scatter : photon_scatter_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_scatter.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_scatter)
