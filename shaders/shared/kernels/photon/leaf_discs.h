// Density estimation over the photons within a radius, by simultaneous search.
#include "shared/kernels/photon/query_sums.h"

#include "shared/kernels/photon/disc_density.h"

#include "shared/kernels/photon/frontier_leaf.h"
