#ifndef ARGAND_SHARED_SAMPLING_H
#define ARGAND_SHARED_SAMPLING_H

#include "shared/lattice.h"
#include "shared/sobol.h"

ARGAND_SHARED_BEGIN

// Random numbers of paths. The first few vertices use quasi-random sequences, where good
// distribution pays most; at later vertices a hash does as well and is cheaper.
CONSTANT uint sobol_dimensions = 4u;

// Which numbers paths use.
CONSTANT uint numbers_hashed = 0u;
CONSTANT uint numbers_sobol = 1u;   // for the first vertices, hashed ones for the others
CONSTANT uint numbers_lattice = 2u; // at all vertices, which share one point of many dimensions

// Eye paths: one sequence per pixel over its samples.
FN vec4 eye_random4(uint seed, uint pixel, uint sample_index, uint dimension, bool lattice) {
    if (lattice) {
        // The dimensions of photons, too: a pass moves its photons by as many times the vector by
        // which it moves the sample as there are photons in a pass.
        return lattice_random4(seed, pixel, sample_index, dimension);
    }
    if (dimension < sobol_dimensions) {
        return sobol_random4(seed, pixel, sample_index, dimension);
    }
    return random4(seed, pixel, sample_index, dimension);
}

// A dimension that no vertex of a photon reaches.
CONSTANT uint dimension_of_choices = 0x10000000u;
// From this dimension on: whether each scattering is aimed.
CONSTANT uint dimension_of_aims = 0x10000001u;

// Photons: one sequence over all of them or, for comparison, the hash at all vertices.
FN vec4 photon_random4(uint seed, uint photon, uint dimension, uint numbers) {
    const uint of_photons = 0x40000000u; // no pixel has this number
    if (numbers == numbers_lattice) {
        // Those of choices and aims lie between those of vertices.
        uint set = dimension < dimension_of_choices ? 2u * dimension
                                                    : 2u * (dimension - dimension_of_choices) + 1u;
        return lattice_random4(seed, of_photons, photon, set);
    }
    if (numbers == numbers_sobol && dimension < sobol_dimensions) {
        return sobol_random4(seed, of_photons, photon, dimension);
    }
    return random4(seed, photon, of_photons, dimension);
}

ARGAND_SHARED_END

#endif
