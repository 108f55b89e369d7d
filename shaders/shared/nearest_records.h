#ifndef ARGAND_SHARED_NEAREST_RECORDS_H
#define ARGAND_SHARED_NEAREST_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Words of a query in shared memory: the bins of its histogram, and later its list of candidates.
// With this group they take the 16 KiB that every device has.
CONSTANT uint nearest_words = 128u;
CONSTANT uint nearest_group = 32u;
CONSTANT uint nearest_listed = 64u; // candidates, two words each

// Mantissa bits of a squared distance that the first histogram neglects: 16 bins an octave, nearly
// 8 octaves.
CONSTANT uint nearest_first_shift = 19u;
CONSTANT uint nearest_zoom_bits = 6u; // a bin is divided into 2^6

CONSTANT uint nearest_counts = 0u; // what a query does: counts photons by distance,
CONSTANT uint nearest_sums = 1u;   // adds up the nearest,
CONSTANT uint nearest_done = 2u;   // nothing any more

CONSTANT uint nearest_none = 0xffffffffu;

// Distances are measured in a ball that is flat along the surface's normal (Jensen 1996): squared,
// plus this times the squared height over the tangent plane; 1 / disc_half_height² - 1.
CONSTANT real nearest_stretch = real(99);

// Least radius of the estimate, in units of r_max: photons in one point do not make it infinite.
CONSTANT real nearest_least = real(1e-3);
CONSTANT real nearest_least_square = real(1e-37); // so that its inverse is finite

// Area samples that a disc should hold for a boundary correction: from half as many on it is faded
// in.
CONSTANT real nearest_trusted_samples = real(32);

// A query for the nearest photons between two dispatches.
struct NearestRecord {
    uint phase;            // nearest_counts, ...
    uint low, high, shift; // bits of squared distances, see nearest_gather
    uint top;
    uint total; // photons counted up to `top`; if done: taken
    uint node, start;
    uint stop, missing, taken, listed;
    uint last; // photon that was taken last; if done with `low` its distance: the k-th nearest
    float32 coverage, coverage_moment;
    uint overflown;
    // In the first three lanes each; see Sum.
    lane4 indirect, indirect_compensation, caustic, caustic_compensation;
    lane4 indirect_moment, indirect_moment_compensation, caustic_moment,
        caustic_moment_compensation;
};

ARGAND_SHARED_END

#endif
