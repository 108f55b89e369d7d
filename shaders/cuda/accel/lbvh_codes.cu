#include "cuda/kernel.h"
#include "kernels/lbvh_codes.twin.h"

namespace argand::twins {
struct lbvh_codes : lbvh_codes_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/lbvh_codes.h"
};
} // namespace argand::twins

ARGAND_TWIN(lbvh_codes)
