// Alpha, for kernels that look up no other textures.
#include "shared/kernels/texel_lookup.h"

#include "shared/kernels/coverage.h"
