#ifndef ARGAND_SHARED_FRONTIER_RECORDS_H
#define ARGAND_SHARED_FRONTIER_RECORDS_H

#include "shared/prelude.h"

ARGAND_SHARED_BEGIN

// Simultaneous search for photons (Keller et al. 2010, algorithm 1). Its frontier are the nodes of
// one level of a hierarchy over queries, which is never stored as a whole. A node has queries that
// lie side by side, and references, side by side too, to the photons that its queries may reach.

// A reference to a photon has four words: the photon's position and its index in the map. A place
// of a query has four words, too: the query's position and its slot.

// The references of a node, and what becomes of the node.
struct FrontierNode {
    uint first, count; // references
    uint state;        // frontier_*
    uint pad0;
};

CONSTANT uint frontier_ended = 0u;  // no photon reaches its queries
CONSTANT uint frontier_leaf = 1u;   // its photons are compared with its queries
CONSTANT uint frontier_active = 2u; // it has children on the next level

// The most children of a node: three partitions of its queries, one after another.
CONSTANT uint most_frontier_children = 8u;

struct FrontierParams {
    uint first, end;  // elements: queries, photons, nodes or chunks
    uint query_leaf;  // most queries of a leaf
    float32 cost;     // of a partition for each photon, over that of comparing it with a query
    float32 reach;    // distance within which photons count, a little enlarged
    uint part;        // map_*
    float32 flatness; // of footprints
    uint chunk;       // references that an invocation takes
};

// How the photons of leaves are added to their queries.
struct FrontierGatherParams {
    uint first, end;   // queries
    uint first_photon; // of each leaf; the next `photons` are added
    uint photons;
    float32 radius;         // of fixed-radius density estimation
    float32 caustic_radius; // radius for caustic photons, at most `radius`
    float32 flatness;       // of footprints
    uint pad0;
};

// How sums become answers.
struct FrontierAnswerParams {
    uint end;                 // queries
    uint boundary_correction; // whether there are area samples
    uint caustic_correction;  // whether they tell the coverage of caustics, too
    uint pad0;
    // Estimates are corrected within this distance of this point, where area samples lie.
    float32 corrected_x, corrected_y, corrected_z, corrected_distance;
};

// Counters of a level: indices into an array of uint.
CONSTANT uint frontier_references = 0u;
CONSTANT uint frontier_parents = 1u; // active nodes
CONSTANT uint frontier_chunks = 2u;  // of active nodes
CONSTANT uint frontier_most = 3u;    // complement of the most photons in a leaf
CONSTANT uint frontier_counters = 4u;

ARGAND_SHARED_END

#endif
