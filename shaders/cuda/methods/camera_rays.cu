#include "cuda/kernel.h"
#include "kernels/camera_rays.twin.h"

namespace argand::twins {
struct camera_rays : camera_rays_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/camera_rays.h"
};
} // namespace argand::twins

ARGAND_TWIN(camera_rays)
