#include "cuda/kernel.h"
#include "kernels/film_add.twin.h"

namespace argand::twins {
struct film_add : film_add_arguments {
    uint thread_index = 0;
#include "shared/kernels/methods/film_add.h"
};
} // namespace argand::twins

ARGAND_TWIN(film_add)
