#include "cuda/kernel.h"
#include "kernels/wide_roots.twin.h"

namespace argand::twins {
struct wide_roots : wide_roots_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/wide_roots.h"
};
} // namespace argand::twins

ARGAND_TWIN(wide_roots)
