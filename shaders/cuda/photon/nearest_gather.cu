#include "cuda/kernel.h"
#include "kernels/nearest_gather.twin.h"

namespace argand::ARGAND_TWINS {
struct nearest_gather : nearest_gather_arguments {
    uint thread_index = 0;
    uint words[nearest_words];
#define WORD(i) words[i]
#include "shared/kernels/photon/nearest_gather.h"
};
} // namespace argand::ARGAND_TWINS

ARGAND_TWIN(nearest_gather)
