#include "cuda/kernel.h"
#include "kernels/photon_order.twin.h"

namespace argand::twins {
struct photon_order : photon_order_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_order.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_order)
