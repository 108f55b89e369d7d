#include "cuda/kernel.h"
#include "kernels/area_samples.twin.h"

namespace argand::twins {
struct area_samples : area_samples_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/area_samples.h"
};
} // namespace argand::twins

ARGAND_TWIN(area_samples)
