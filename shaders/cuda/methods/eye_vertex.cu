#include "cuda/kernel.h"
#include "kernels/eye_vertex.twin.h"

namespace argand::twins {
struct eye_vertex : eye_vertex_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/eye_vertex.h"
};
} // namespace argand::twins

ARGAND_TWIN(eye_vertex)
