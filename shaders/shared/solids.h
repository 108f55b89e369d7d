// Sets of solids that a point lies in, one bit for each rank (MaterialRecord::solids). Where solids
// overlap, the one of the highest rank is there, and surfaces of the others that lie inside it are
// not (Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images"). Solids without a
// rank have no bit, and count as higher than all others.
#ifndef ARGAND_SHARED_SOLIDS_H
#define ARGAND_SHARED_SOLIDS_H

#include "shared/material_record.h"

ARGAND_SHARED_BEGIN

CONSTANT uint most_ranked_solids = 20u; // so many bits of a ray are free (kernels/medium.h)
CONSTANT uint solid_rank_mask = 31u;
CONSTANT uint solid_of_rank_shift = 5u;

// The solid's bit; 0: it has no rank.
FN uint solid_bit(IN(MaterialRecord) m) {
    uint rank = m.solids & solid_rank_mask;
    return rank > 0u ? 1u << (rank - 1u) : 0u;
}

// The solids on the side of a solid's surface from which a ray comes. known: those that the ray
// knows of; front: it meets the surface from outside.
FN uint solids_before(uint known, uint bit, bool front) { return front ? known : known | bit; }

// The solids on the other side.
FN uint solids_behind(uint before, uint bit, bool front) {
    return front ? before | bit : before & ~bit;
}

// Whether the surface of the solid lies inside another one of higher rank.
FN bool is_in_higher_solid(uint before, uint bit) { return bit != 0u && (before & ~bit) > bit; }

// The highest rank in a set that is not empty.
FN uint highest_solid(uint solids) { return uint(findMSB(solids)); }

// Index of refraction of a solid relative to the one around it. An index of 0 reflects all light,
// also where the other one is 0.
FN real relative_ior(real ior, real around) { return around > real(0.0) ? ior / around : ior; }

ARGAND_SHARED_END

#endif
