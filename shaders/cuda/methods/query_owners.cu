#include "cuda/kernel.h"
#include "kernels/query_owners.twin.h"

namespace argand::twins {
struct query_owners : query_owners_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/query_owners.h"
};
} // namespace argand::twins

ARGAND_TWIN(query_owners)
