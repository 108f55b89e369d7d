#include "cuda/kernel.h"
#include "kernels/photon_codes.twin.h"

namespace argand::twins {
struct photon_codes : photon_codes_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_codes.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_codes)
