#include "cuda/kernel.h"
#include "kernels/estimate_add.twin.h"

namespace argand::twins {
struct estimate_add : estimate_add_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/estimate_add.h"
};
} // namespace argand::twins

ARGAND_TWIN(estimate_add)
