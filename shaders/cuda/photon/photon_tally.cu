#include "cuda/kernel.h"
#include "kernels/photon_tally.twin.h"

namespace argand::twins {
struct photon_tally : photon_tally_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_tally.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_tally)
