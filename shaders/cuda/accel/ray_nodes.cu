#include "cuda/kernel.h"
#include "kernels/ray_nodes.twin.h"

namespace argand::twins {
struct ray_nodes : ray_nodes_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/ray_nodes.h"
};
} // namespace argand::twins

ARGAND_TWIN(ray_nodes)
