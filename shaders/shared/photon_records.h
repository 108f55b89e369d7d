#ifndef ARGAND_SHARED_PHOTON_RECORDS_H
#define ARGAND_SHARED_PHOTON_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// What the map keeps: a photon, or a sample of the surfaces' area, whose flux_r is the area that it
// stands for.
struct PhotonRecord {
    float32 x, y, z;
    uint
        normal; // of the surface, on the photon's side (area samples: its front), packed (photon.h)
    float32 flux_r, flux_g, flux_b;
    uint direction; // where it came from, and how often it was scattered, packed
                    // (pack_photon_direction)
};

// A photon on its way, one per slot.
struct PhotonPathRecord {
    float32 flux_r, flux_g, flux_b;
    uint state; // scatterings so far in the low half, photon_followed
};

CONSTANT uint photon_depth_mask = 0xffffu;
CONSTANT uint photon_followed = 0x10000u; // all scatterings so far were followed lobes

// Where the flux of one photon went, in fixed point (PhotonBatch::flux_unit), one column a channel,
// modulo 2^32: emitted = absorbed + escaped + cut, to the bit.
struct FluxLedger {
    uvec4 emitted, absorbed, escaped, cut;
};

// A part of the pass's photons, traced together.
struct PhotonBatch {
    uint seed;
    uint first, count;     // photons of this batch, numbered through the whole picture
    float32 inverse_total; // 1 / photons emitted in the whole pass, which share each light's power
    uint bounces;          // the most scatterings of a photon that is stored
    uint capacity;         // slots for stored photons
    float32 flux_unit;     // flux of one unit of the fixed-point sums
    float32 emitter_probability; // that a photon comes from an emissive triangle
};

struct PhotonAdvanceParams {
    uint stored; // whether the last bounce stored photons
    uint capacity;
    uint pad0, pad1;
};

struct AreaSampleParams {
    uint seed;
    uint count;
    uint step;    // between two samples, in the units of the summed areas: 2^32 / count
    float32 area; // of one sample
    uint triangle_count;
    uint capacity;
    uint pad0, pad1;
};

struct FluxSumParams {
    uint count; // ledgers
    uint pad0, pad1, pad2;
};

// Parts of the map: its tree divides caustic photons from all others, at the root.
CONSTANT uint map_whole = 0u;
CONSTANT uint map_indirect = 1u; // and area samples
CONSTANT uint map_caustic = 2u;

struct PhotonGatherParams {
    uint budget;              // iterations of a dispatch
    uint first;               // whether this is the first dispatch of these queries
    uint count_index;         // of the number of queries
    uint boundary_correction; // whether the map holds area samples
    float32 radius;           // of density estimation within a radius
    float32 caustic_radius;   // the same of caustic photons, at most `radius`
    float32 flatness;         // of footprints
    uint neighbours;          // k
    float32 samples_per_area; // area samples
    uint first_query;         // of this dispatch
    uint places; // for queries that are put aside; 0: they are not (nearest_gather only)
    uint part;   // map_*
};

// A query of the photon map between two dispatches: the node to go on with, and the sums so far.
struct GatherRecord {
    float32 indirect_r, indirect_g, indirect_b;
    uint node;
    float32 caustic_r, caustic_g, caustic_b;
    float32 coverage;
    float32 indirect_compensation_r, indirect_compensation_g, indirect_compensation_b,
        pad0; // of the sums, see Sum
    float32 caustic_compensation_r, caustic_compensation_g, caustic_compensation_b, pad1;
};

// Slots that one invocation counts (photon_tally).
CONSTANT uint slots_per_tally = 64u;

// A leaf of the map: the place of its first photon, and above it how many more there are.
CONSTANT uint leaf_first_bits = 23u;
CONSTANT uint leaf_first_mask = 0x7fffffu;
CONSTANT uint most_photons_a_leaf = 512u;
CONSTANT uint most_photons_in_map = 0x800000u;

struct PhotonBoxParams {
    float32 flatness; // of footprints
    uint pad0, pad1, pad2;
};

struct PhotonLeafParams {
    uint leaf_size; // photons in a leaf at most
    uint pad0, pad1, pad2;
};

// Counters of the photon map, on the device: indices into an array of uint.
CONSTANT uint counter_active = 0u;       // photons still on their way
CONSTANT uint counter_stored_slots = 1u; // slots of the map used so far (a slot may hold no photon)
CONSTANT uint counter_stored = 2u;       // records in the map
CONSTANT uint counter_overflow = 3u;     // slots that were wanted beyond the capacity
CONSTANT uint counter_next_active = 4u;
CONSTANT uint counter_leaves = 5u;      // of the map
CONSTANT uint counter_photons = 6u;     // photons among them
CONSTANT uint counter_footprints = 7u;  // sum of the footprints' areas, in shares of the scene's
CONSTANT uint counter_area_places = 8u; // area samples among the records
CONSTANT uint counter_count = 16u;

ARGAND_SHARED_END

#endif
