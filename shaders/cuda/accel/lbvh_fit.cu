#include "cuda/kernel.h"
#include "kernels/lbvh_fit.twin.h"

namespace argand::twins {
struct lbvh_fit : lbvh_fit_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/lbvh_fit.h"
};
} // namespace argand::twins

ARGAND_TWIN(lbvh_fit)
