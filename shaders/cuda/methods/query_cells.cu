#include "cuda/kernel.h"
#include "kernels/query_cells.twin.h"

namespace argand::twins {
struct query_cells : query_cells_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/query_cells.h"
};
} // namespace argand::twins

ARGAND_TWIN(query_cells)
