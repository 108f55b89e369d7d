#include "cuda/kernel.h"
#include "kernels/shadow_add.twin.h"

namespace argand::twins {
struct shadow_add : shadow_add_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/shadow_add.h"
};
} // namespace argand::twins

ARGAND_TWIN(shadow_add)
