// Density estimation over the footprints that contain a query point, by a walk through the map's
// tree.
#include "shared/kernels/photon/query_state.h"

#include "shared/kernels/photon/footprint_density.h"

#include "shared/kernels/photon/query_walk.h"
