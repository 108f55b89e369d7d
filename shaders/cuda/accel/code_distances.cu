#include "cuda/kernel.h"
#include "kernels/code_distances.twin.h"

namespace argand::twins {
struct code_distances : code_distances_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/code_distances.h"
};
} // namespace argand::twins

ARGAND_TWIN(code_distances)
