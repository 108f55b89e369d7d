#include "cuda/kernel.h"
#include "kernels/triangle_boxes.twin.h"

namespace argand::twins {
struct triangle_boxes : triangle_boxes_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/triangle_boxes.h"
};
} // namespace argand::twins

ARGAND_TWIN(triangle_boxes)
