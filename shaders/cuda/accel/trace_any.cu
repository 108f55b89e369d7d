#include "cuda/kernel.h"
#include "kernels/trace_any.twin.h"

namespace argand::twins {
struct trace_any : trace_any_arguments {
    uint thread_index = 0;
#include "shared/kernels/accel/trace_any.h"
};
} // namespace argand::twins

ARGAND_TWIN(trace_any)
