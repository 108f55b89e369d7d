// Density estimation over the footprints that contain a query point, by simultaneous search.
#include "shared/kernels/photon/query_sums.h"

#include "shared/kernels/photon/footprint_density.h"

#include "shared/kernels/photon/frontier_leaf.h"
