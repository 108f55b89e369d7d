#ifndef ARGAND_SHARED_PHOTON_RECORDS_H
#define ARGAND_SHARED_PHOTON_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// A record of the map: a photon, or a sample of the surfaces' area. In an area sample flux_r and
// flux_g are the areas that it represents on the front and on the back: 0 on a side where another
// surface lies so close over it that no light reaches it. Its direction is the index of its
// triangle.
struct PhotonRecord {
    float32 x, y, z;
    // Packed normal of the surface (photon.h), on the photon's side; the front's for area samples.
    uint normal;
    float32 flux_r, flux_g, flux_b;
    // Direction that the photon came from, number of scatterings, and how densely photons like it
    // were aimed (pack_photon_direction).
    uint direction;
};

// A photon that is being traced, one per slot.
struct PhotonPathRecord {
    float32 flux_r, flux_g, flux_b;
    // Scatterings so far in the low half; photon_followed; photon_view_shift; photon_outside_shift;
    // photon_aimed_shift.
    uint state;
};

CONSTANT uint photon_depth_mask = 0xffffu;
CONSTANT uint photon_followed = 0x10000u; // only followed lobes scattered the photon so far
// From this bit on: the logarithm to base 2, rounded down, of the density of photons that were
// aimed at what is in view when they were last emitted or scattered outside it, over the density
// without aiming.
CONSTANT uint photon_view_shift = 17u;
// From this bit on, of a photon from outside: the logarithm to base 2, rounded down, of the density
// of its tree (aim.h), over that of the rarest photons.
CONSTANT uint photon_outside_shift = 22u;
// Of both fields.
CONSTANT uint photon_density_mask = 31u;
// From this bit on: the logarithm to base 2 of the density of photons aimed at a caster of caustics
// over that of even emission, rounded down; 0 after other scatterings.
CONSTANT uint photon_aimed_shift = 27u;
CONSTANT uint largest_photon_aimed = 30u;

// Where the flux of one photon went, per channel, in fixed point (PhotonBatch::flux_unit) modulo
// 2^32. `cut` is flux truncated at the bounce limit; `lost` is that of photons whose hits no cube
// map shows. emitted = absorbed + escaped + cut + lost, to the bit.
struct FluxLedger {
    uvec4 emitted, absorbed, escaped, cut, lost;
};

// Where a photon's path begins or meets a surface, and the index of the vertex before. Those of a
// photon of the pass lie at twice its number, light and first hit, and those of slots behind all.
struct PathVertex {
    float32 x, y, z;
    uint previous; // no_vertex: the path begins here
};

CONSTANT uint no_vertex = 0xffffffffu;

// What photons keep for the sizes of their footprints.
CONSTANT uint extents_none = 0u;
CONSTANT uint extents_differentials = 1u; // carried from the light on
CONSTANT uint extents_splats = 2u;        // the length and the slant of the last ray

// What may be kept of photons: the index of their light, the vertices of their path, and where they
// start, as a hit.
CONSTANT uint kept_light = 1u;
CONSTANT uint kept_path = 2u;
CONSTANT uint kept_start = 4u;

// A batch of the pass's photons, traced together.
struct PhotonBatch {
    uint seed;
    uint first, count;     // photons of this batch, numbered through the whole image
    float32 inverse_total; // 1 / photons of the whole pass, which share each light's power
    uint bounces;          // most scatterings of a stored photon
    uint capacity;         // slots for stored photons
    float32 flux_unit;     // flux of one unit of the fixed-point sums
    // 1 / photons that cover the scene together, for the spacing between them: those of the pass,
    // and of others that count with it.
    float32 inverse_spread;
    uint least_scatterings; // of a stored photon: 1, or 0 where photons account for direct light
    // Whether photons have slots in this round of tracing. Those that pass surfaces are in the same
    // round as others with more scatterings.
    uint has_slots;
    uint first_path; // number of the batch's first photon within its pass
    uint paths;      // photons of the pass
};

struct PhotonAdvanceParams {
    uint stored; // whether the last bounce stored photons
    uint capacity;
    uint pad0, pad1;
};

// A piece of a triangle, and the area of all pieces before it, over the whole, times 2^32.
struct AreaSumRecord {
    uint before;
    uint triangle;
    uint piece; // triangle_piece.h
};

struct AreaSampleParams {
    uint seed;
    uint count;
    uint step;    // distance between samples in units of the summed areas: 2^32 / count
    float32 area; // of one sample
    uint piece_count;
    uint capacity;
    uint offset; // of the first sample, below `step`
    uint pad;
};

// Sides of area samples, 2 × sample + 1 for the back, to which short rays find what lies on them.
struct AreaCoverParams {
    uint first, count; // sides of this batch
    uint counter;      // that holds the number of active rays
    float32 height;    // at which the rays start
    float32 error;     // bound of the rounding errors of positions
};

struct FluxSumParams {
    uint count; // number of ledgers
    uint pad0, pad1, pad2;
};

// Parts of the map. The root of its tree separates caustic photons from all other records.
CONSTANT uint map_whole = 0u;
CONSTANT uint map_indirect = 1u; // with the area samples
CONSTANT uint map_caustic = 2u;

struct PhotonGatherParams {
    uint budget;      // iterations per dispatch
    uint first;       // whether this is the first dispatch of these queries
    uint count_index; // index of the number of queries
    // Whether the map holds area samples, which correct estimates near edges.
    uint boundary_correction;
    float32 radius;           // of fixed-radius density estimation
    float32 caustic_radius;   // radius for caustic photons, at most `radius`
    float32 flatness;         // of footprints
    uint neighbours;          // k
    float32 samples_per_area; // area samples
    uint first_query;         // first query of this dispatch
    // Places for suspended queries; 0: queries are not suspended (nearest_gather only).
    uint places;
    uint part; // part of the map: map_*
    // Estimates are corrected within this distance of this point, where area samples lie.
    float32 corrected_x, corrected_y, corrected_z, corrected_distance;
};

// State of a photon map query between two dispatches: the next node and the sums so far.
struct GatherRecord {
    float32 indirect_r, indirect_g, indirect_b;
    uint node;
    float32 caustic_r, caustic_g, caustic_b;
    float32 coverage;
    float32 indirect_compensation_r, indirect_compensation_g, indirect_compensation_b, square;
    float32 caustic_compensation_r, caustic_compensation_g, caustic_compensation_b, weight;
    // These, `square` and `weight`: see Moments.
    float32 flux_offset_x, flux_offset_y, flux_offset_z, area_offset_x, area_offset_y,
        area_offset_z, weight_square;
};

// Slots that one invocation counts (photon_tally).
CONSTANT uint slots_per_tally = 64u;

// A leaf of the map packs the index of its first photon and, above it, the number of further
// photons.
CONSTANT uint leaf_first_bits = 23u;
CONSTANT uint leaf_first_mask = 0x7fffffu;
CONSTANT uint most_photons_a_leaf = 512u;
CONSTANT uint most_photons_in_map = 0x800000u;

// Which photons photon_distances looks at, of those in the order of codes.
struct PhotonDistanceParams {
    uint points;
    uint rank;   // of the distance to find among the photons looked at, from 1
    uint reach;  // photons looked at on either side of a point's place in the order
    uint stride; // between photons looked at
    // Photons that are not caustic, and caustic ones behind them.
    uint others, caustics;
    // 0: the points are given. Else they are every step-th caustic photon, and only caustic photons
    // are looked at.
    uint caustic_step;
    uint pad0;
};

struct PhotonBoxParams {
    float32 flatness; // of footprints
    uint pad0, pad1, pad2;
};

struct PhotonLeafParams {
    uint leaf_size; // most photons in a leaf
    uint pad0, pad1, pad2;
};

// Area samples in a leaf of an area tree (area_tree.hpp).
CONSTANT uint area_block = 8u;

// Footprints and discs of caustics that are expected to hold fewer area samples are not corrected.
CONSTANT real least_cover_samples = real(8.0);

struct AreaBlockParams {
    uint samples;
    uint pad0, pad1, pad2;
};

// How much of caustics' footprints and discs lies on surfaces (covered_share.h).
struct CoverParams {
    float32 samples_per_area;
    uint samples; // of the area tree
    // Area samples lie within this distance of this point.
    float32 corrected_x, corrected_y, corrected_z, corrected_distance;
    float32 flatness;       // of footprints
    float32 squared_radius; // of discs; 0: each has its own
    uint count_index;       // index of the number of queries
    uint pad0, pad1, pad2;
};

// Counters of the photon map on the device: indices into an array of uint.
CONSTANT uint counter_active = 0u;       // photons that are still traced
CONSTANT uint counter_stored_slots = 1u; // slots of the map in use (a slot may hold no photon)
CONSTANT uint counter_stored = 2u;       // records in the map
CONSTANT uint counter_overflow = 3u;     // slots requested beyond the capacity
CONSTANT uint counter_next_active = 4u;
CONSTANT uint counter_leaves = 5u;  // leaves of the map
CONSTANT uint counter_photons = 6u; // photons among the records
// Sum of the footprints' areas, in units of the scene's area / area_shares.
CONSTANT uint counter_footprints = 7u;
CONSTANT uint counter_area_places = 8u; // area samples among the records
CONSTANT uint counter_others = 9u;      // photons of the map that are not caustic, which come first
CONSTANT uint counter_near = 10u;       // photons from nearby surfaces, stored or not
CONSTANT uint counter_wide_caustics = 11u; // caustic photons whose footprints hold area samples
CONSTANT uint counter_count = 16u;

ARGAND_SHARED_END

#endif
