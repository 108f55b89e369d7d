#include "cuda/kernel.h"
#include "kernels/photon_emit.twin.h"

namespace argand::twins {
struct photon_emit : photon_emit_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_emit.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_emit)
