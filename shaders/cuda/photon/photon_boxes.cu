#include "cuda/kernel.h"
#include "kernels/photon_boxes.twin.h"

namespace argand::twins {
struct photon_boxes : photon_boxes_arguments {
    uint thread_index = 0;
#include "shared/kernels/photon/photon_boxes.h"
};
} // namespace argand::twins

ARGAND_TWIN(photon_boxes)
