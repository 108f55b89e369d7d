#include "cuda/kernel.h"
#include "kernels/ray_triangles.twin.h"

namespace argand::twins {
struct ray_triangles : ray_triangles_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/ray_triangles.h"
};
} // namespace argand::twins

ARGAND_TWIN(ray_triangles)
