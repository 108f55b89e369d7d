#version 460
layout(local_size_x = 64) in;
#include "kernel.glsl"
#include "shared/morton.h"
#include "shared/photon.h"

layout(set = 0, binding = 0) readonly buffer Codes { uint codes[]; };
layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) writeonly buffer Leaves { uint leaves[]; };
layout(set = 0, binding = 3) writeonly buffer Heads { uint heads[]; };
layout(push_constant) uniform Push { PhotonLeafParams params; };

const uint far = 64u;

// How far photons i and i + 1 are apart in the tree over all photons, as in accel/lbvh_fit.comp.
uint distance_after(uint i) { return 63u - common_prefix(codes[i], i, codes[i + 1u], i + 1u); }

// The largest subtree of at most leaf_size photons around each photon, of which the first one is the head: these are the
// leaves that are left where splits below the threshold are undone (Fabianowski and Dingliana 2009, §6.2), and their
// number is known before the tree is built.
void main() {
    uint i = THREAD_INDEX;
    uint stored = counters[counter_stored];
    if (i >= stored) {
        return;
    }
    uint first = i;
    uint last = i;
    for (;;) {
        uint before = first > 0u ? distance_after(first - 1u) : far;
        uint after = last + 1u < stored ? distance_after(last) : far;
        uint split = min(before, after);
        // Caustic photons and others are parted at the root, and never in one leaf.
        if (split >= 32u + photon_kind_shift) {
            break;
        }
        // The parent reaches as far as neighbours are no farther apart than its two children.
        uint parent_first = first;
        uint parent_last = last;
        while (parent_last - parent_first < params.leaf_size && parent_last + 1u < stored &&
               distance_after(parent_last) <= split) {
            ++parent_last;
        }
        while (parent_last - parent_first < params.leaf_size && parent_first > 0u &&
               distance_after(parent_first - 1u) <= split) {
            --parent_first;
        }
        if (parent_last - parent_first >= params.leaf_size) {
            break;
        }
        first = parent_first;
        last = parent_last;
    }
    leaves[i] = first | ((last - first) << leaf_first_bits);
    heads[i] = first == i ? 1u : 0u;
}
