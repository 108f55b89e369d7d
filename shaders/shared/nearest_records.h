#ifndef ARGAND_SHARED_NEAREST_RECORDS_H
#define ARGAND_SHARED_NEAREST_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Words of shared memory per query: first the bins of its histogram, later its list of candidates.
// A work-group of nearest_group queries uses 16 KiB, which every device has.
CONSTANT uint nearest_words = 128u;
CONSTANT uint nearest_group = 32u;
CONSTANT uint nearest_listed = 64u; // candidates, two words each

// Mantissa bits of a squared distance that the first histogram ignores: 16 bins per octave,
// covering nearly 8 octaves.
CONSTANT uint nearest_first_shift = 19u;
CONSTANT uint nearest_zoom_bits = 6u; // zooming divides a bin into 2^6

CONSTANT uint nearest_counts = 0u; // phase of a query: counts photons by distance,
CONSTANT uint nearest_sums = 1u;   // adds up the nearest,
CONSTANT uint nearest_done = 2u;   // is finished

CONSTANT uint nearest_none = 0xffffffffu;

// Distances are measured in a ball flattened along the surface's normal (Jensen 1996): the squared
// distance plus this factor times the squared height over the tangent plane. The factor is 1 /
// disc_half_height² - 1.
CONSTANT real nearest_stretch = real(99);

// Least radius of an estimate, in units of r_max, so that coincident photons do not make it
// infinite.
CONSTANT real nearest_least = real(1e-3);
CONSTANT real nearest_least_square = real(1e-37); // keeps its inverse finite

// Area samples that a disc should hold for its boundary correction; the correction fades in from
// half as many.
CONSTANT real nearest_trusted_samples = real(32);

// State of a query for the nearest photons between two dispatches.
struct NearestRecord {
    uint phase;            // nearest_counts, nearest_sums or nearest_done
    uint low, high, shift; // bits of squared distances, see nearest_gather.h
    uint top;
    uint total; // photons counted up to `top`; when done: photons taken
    uint node, start;
    uint stop, missing, taken, listed;
    // Photon taken last. When done, `low` holds its distance: it is the k-th nearest.
    uint last;
    float32 coverage, coverage_moment;
    uint overflown;
    // Sums in the first three lanes each; see Sum. The fourth of `indirect` is
    // Moments::weight_square.
    lane4 indirect, indirect_compensation, caustic, caustic_compensation;
    lane4 indirect_moment, indirect_moment_compensation, caustic_moment,
        caustic_moment_compensation;
    // Moments, with equal weights: flux_offset and square, area_offset and weight.
    lane4 flux_moments, area_moments;
};

ARGAND_SHARED_END

#endif
