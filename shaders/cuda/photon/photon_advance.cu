#include "cuda/kernel.h"
#include "kernels/photon_advance.twin.h"

namespace argand::twins {
struct photon_advance : photon_advance_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_advance.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_advance)
