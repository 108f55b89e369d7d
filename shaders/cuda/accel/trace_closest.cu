#include "cuda/kernel.h"
#include "kernels/trace_closest.twin.h"

namespace argand::twins {
struct trace_closest : trace_closest_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/trace_closest.h"
};
} // namespace argand::twins

ARGAND_TWIN(trace_closest)
