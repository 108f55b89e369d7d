// Density estimation over the photons within a radius, by a walk through the map's tree.
#include "shared/kernels/photon/query_state.h"

#include "shared/kernels/photon/disc_density.h"

#include "shared/kernels/photon/query_walk.h"
