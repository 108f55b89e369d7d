// Density estimation over exactly the k nearest photons within r_max (Jensen 1996). Ties go to the
// photon that comes first in the map. WORD(i) is the i-th of the query's nearest_words words of
// working memory.
//
// The selection counts; it keeps no heap. A heap takes k words of memory per query, and each
// insertion is a chain of dependent reads of different length in each lane of a subgroup. Instead:
// - A first walk counts photons in a histogram, whose bins are ranges of the bits of squared
//   distances. It shrinks its radius whenever the bins below it hold k photons.
// - If the bin of the k-th photon holds many photons, it is divided into bins, and the walk
//   repeated.
// - A second walk adds up all photons in lower bins, and lists the few photons of that bin, of
//   which the nearest are selected.
// Epanechnikov's kernel is linear in the squared distance, so the sums of flux and of flux times
// squared distance are enough: the kernel's radius need not be known during the walk.
#include "shared/kernels/photon/query.h"

#include "shared/kernels/photon/answer.h"
#include "shared/kernels/photon/map_walk.h"
#include "shared/kernels/photon/trusted_share.h"

// Bin 0 holds bits below `low`, bin i those from low + ((i - 1) << shift) to low + (i << shift); no
// bin holds bits of `high` or more.
struct Search {
    uint phase;
    uint low, high, shift;
    uint top;         // bin of the k-th nearest of the photons counted so far
    uint total;       // photons in bins 0 to top
    uint start, stop; // first photons of the leaves at which the walk began, if it still has to go
                      // around, and at which it ends
    // Second walk: photons with bits below `low` are taken, those from `low` up to `high` are
    // candidates.
    uint missing;     // candidates still to take
    uint taken, last; // candidates that were taken if all have one distance; the last one taken
    uint listed;
    bool overflown;                      // the list has no room for all candidates
    Sum indirect_moment, caustic_moment; // flux times squared distance, in units of `unit`
    real coverage_moment;
};

FN real squared_distance(Query q, vec3 d) {
    real height = dot3(d, q.normal);
    return dot3(d, d) + nearest_stretch * (height * height);
}

FN uint bin_start(Search s, uint bin) {
    return bin == 0u ? 0u : min(s.low + ((bin - 1u) << s.shift), s.high);
}

// A leaf near p: at every node, the descent takes the child whose box is nearer.
FN uint near_leaf(vec3 p, INOUT(uint) steps) {
    uint node = first_node(params.part);
    while (node != lbvh_end && (node & 1u) == 0u) {
        ++steps;
        uint left = NODES(2u * node).w;
        uvec4 low = NODES(2u * left);
        uvec4 high = NODES(2u * left + 1u);
        uint right = high.w;
        real to_left = distance2_to_box(p, low, high);
        low = NODES(2u * right);
        high = NODES(2u * right + 1u);
        node = to_left <= distance2_to_box(p, low, high) ? left : right;
    }
    return node;
}

FN void clear_bins() {
    for (uint i = 0u; i < nearest_words; ++i) {
        WORD(i) = 0u;
    }
}

// Empties the sums and the list of the second walk. A query that is put aside during the first one
// stores them too, so they must be defined by then.
FN void clear_sums(INOUT(Query) q, INOUT(Search) s) {
    s.taken = 0u;
    s.listed = 0u;
    s.last = nearest_none;
    s.overflown = false;
    s.indirect_moment = Sum(vec3(real(0.0)), vec3(real(0.0)));
    s.caustic_moment = Sum(vec3(real(0.0)), vec3(real(0.0)));
    s.coverage_moment = real(0.0);
    q.indirect = Sum(vec3(real(0.0)), vec3(real(0.0)));
    q.caustic = Sum(vec3(real(0.0)), vec3(real(0.0)));
    q.coverage = real(0.0);
    q.moments = no_moments();
}

// Begins to count in bins for the whole ball of r_max. The walk starts near the query, so that its
// radius shrinks soon.
FN void start_counting(INOUT(Query) q, INOUT(Search) s, INOUT(uint) steps) {
    s.phase = nearest_counts;
    s.missing = 0u;
    clear_sums(q, s);
    s.high = float_bits(params.radius * params.radius);
    s.shift = nearest_first_shift;
    uint span = (nearest_words - 1u) << s.shift;
    s.low = s.high > span ? s.high - span : 0u;
    s.top = nearest_words - 1u;
    s.total = 0u;
    q.node = near_leaf(q.p, steps);
    s.start = q.node == lbvh_end ? nearest_none : NODES(2u * q.node).w & leaf_first_mask;
    s.stop = nearest_none;
    clear_bins();
}

// Begins to count in bins for [low, high) only, where the k-th nearest photon is.
FN void zoom(INOUT(Query) q, INOUT(Search) s, uint low, uint high) {
    s.phase = nearest_counts;
    s.high = high;
    s.low = low;
    if (low == 0u) {
        // The whole range below `high`, of any magnitude.
        s.shift = uint(max(findMSB(high) - 5, 0));
    } else {
        s.shift = max(s.shift, nearest_zoom_bits) - nearest_zoom_bits;
    }
    s.top = nearest_words - 1u;
    s.total = 0u;
    s.start = nearest_none;
    s.stop = nearest_none;
    q.node = first_node(params.part);
    clear_bins();
}

// First walk: counts photons by distance. Returns false if the budget ended first.
FN bool count_photons(INOUT(Query) q, INOUT(Search) s, INOUT(uint) steps) {
    uint bound = bin_start(s, s.top + 1u);
    for (;;) {
        PhotonRange range = next_leaf(q.p, bits_float(bound), params.budget, q.node, steps);
        if (range.end == 0u && q.node != lbvh_end) {
            return false;
        }
        if (range.end == 0u || range.first >= s.stop) {
            q.node = lbvh_end;
            if (s.start == nearest_none) {
                return true;
            }
            s.stop = s.start;
            s.start = nearest_none;
            q.node = first_node(params.part);
            continue;
        }
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            vec3 chord = bits_float(uvec3(place)) - q.p;
            uint bits = float_bits(squared_distance(q, chord));
            if (bits < bound && (place.w & area_sample_bit) == 0u &&
                on_same_surface(q, place.w, chord)) {
                uint bin = bits < s.low ? 0u : 1u + ((bits - s.low) >> s.shift);
                WORD(bin) += 1u;
                ++s.total;
            }
        }
        while (s.total >= params.neighbours && s.total - WORD(s.top) >= params.neighbours) {
            s.total -= WORD(s.top);
            --s.top;
        }
        bound = bin_start(s, s.top + 1u);
    }
}

// After a count: starts the sums, or another count.
FN void judge_count(INOUT(Query) q, INOUT(Search) s) {
    bool all = s.total < params.neighbours;
    uint in_top = WORD(s.top);
    uint low = all ? s.high : bin_start(s, s.top);
    uint high = all ? s.high : bin_start(s, s.top + 1u);
    if (!all && high - low > 1u && in_top > nearest_listed) {
        zoom(q, s, low, high);
        return;
    }
    s.phase = nearest_sums;
    s.missing = all ? 0u : params.neighbours - (s.total - in_top);
    s.low = low;
    s.high = high;
    clear_sums(q, s);
    q.node = first_node(params.part);
}

FN real least_r2() {
    return max(nearest_least * nearest_least * (params.radius * params.radius),
               nearest_least_square);
}

// Second walk: adds up photons. Returns false if the budget ended first.
FN bool sum_photons(INOUT(Query) q, INOUT(Search) s, INOUT(uint) steps) {
    bool one_distance = s.high - s.low == 1u;
    real radius2 = bits_float(s.high);
    real inverse_unit = real(1.0) / max(radius2, least_r2());
    for (;;) {
        PhotonRange range = next_leaf(q.p, radius2, params.budget, q.node, steps);
        if (range.end == 0u) {
            return q.node == lbvh_end;
        }
        vec3 indirect = vec3(real(0.0));
        vec3 indirect_moment = vec3(real(0.0));
        vec3 caustic = vec3(real(0.0));
        vec3 caustic_moment = vec3(real(0.0));
        steps += range.end - range.first;
        for (uint j = range.first; j < range.end; ++j) {
            uvec4 place = PHOTONS(2u * j);
            vec3 chord = bits_float(uvec3(place)) - q.p;
            real d2 = squared_distance(q, chord);
            uint bits = float_bits(d2);
            if (bits >= s.high || !on_same_surface(q, place.w, chord)) {
                continue;
            }
            bool is_area = (place.w & area_sample_bit) != 0u;
            if (bits >= s.low) {
                if (!one_distance) {
                    if (s.listed < nearest_listed) {
                        WORD(2u * s.listed) = bits;
                        WORD(2u * s.listed + 1u) = j | (place.w & area_sample_bit);
                        ++s.listed;
                    } else {
                        s.overflown = true;
                    }
                    continue;
                }
                if (!is_area) {
                    if (s.taken == s.missing) {
                        continue;
                    }
                    ++s.taken;
                    s.last = j;
                }
            }
            uvec4 carried = PHOTONS(2u * j + 1u);
            real share = d2 * inverse_unit;
            if (is_area) {
                real area = open_area(q, carried);
                q.coverage += area;
                add_area(q.moments, area, chord);
                s.coverage_moment += area * share;
            } else {
                Scattered light = scattered(q, carried);
                vec3 term = light.radiance;
                if (is_caustic(place)) {
                    caustic += term;
                    caustic_moment += term * share;
                } else {
                    indirect += term;
                    indirect_moment += term * share;
                    add_flux(q.moments, term, light.weight, chord, dot3(chord, chord));
                }
            }
        }
        add(q.indirect, indirect);
        add(s.indirect_moment, indirect_moment);
        if (caustics) {
            add(q.caustic, caustic);
            add(s.caustic_moment, caustic_moment);
        }
    }
}

// Selects the last candidate that is taken as s.last, and returns the bits of its squared distance.
FN uint select_last(INOUT(Search) s) {
    for (uint i = 0u; i < s.listed; ++i) {
        uint bits = WORD(2u * i);
        uint index = WORD(2u * i + 1u);
        uint before = 0u;
        for (uint j = 0u; j < s.listed; ++j) {
            uint other = WORD(2u * j);
            bool is_area = (WORD(2u * j + 1u) & area_sample_bit) != 0u;
            before += !is_area && (other < bits || (other == bits && j < i)) ? 1u : 0u;
        }
        if ((index & area_sample_bit) == 0u && before + 1u == s.missing) {
            s.last = index;
            return bits;
        }
    }
    return s.high; // nothing is missing
}

FN void finish(INOUT(Query) q, INOUT(Search) s) {
    bool one_distance = s.high - s.low == 1u;
    real unit = max(bits_float(s.high), least_r2());
    uint last_bits = one_distance ? s.low : select_last(s);
    // The k-th nearest photon lies on the edge of the disc, where its weight is 0. So the mean is
    // right for evenly spread photons: (k - 1) / (π r²) is the unbiased estimate of their density.
    // With fewer than k photons the disc is that of r_max.
    real r2 = max(bits_float(last_bits), least_r2());
    real inverse_r2 = real(1.0) / r2;
    real ratio = unit * inverse_r2;
    // Negative differences come from rounding only.
    vec3 indirect = max(q.indirect.value - s.indirect_moment.value * ratio, vec3(real(0.0)));
    vec3 equal_flux = q.indirect.value; // of equal weights, as in the moments
    real equal_area = q.coverage;
    vec3 caustic = caustics ? max(q.caustic.value - s.caustic_moment.value * ratio, vec3(real(0.0)))
                            : vec3(real(0.0));
    real coverage = max(q.coverage - s.coverage_moment * ratio, real(0.0));
    for (uint i = 0u; i < s.listed; ++i) {
        uint bits = WORD(2u * i);
        uint index = WORD(2u * i + 1u);
        bool is_area = (index & area_sample_bit) != 0u;
        index &= ~area_sample_bit;
        if (bits > last_bits || (bits == last_bits && !is_area && index > s.last)) {
            continue;
        }
        real weight = kernel_weight(bits_float(bits) * inverse_r2);
        uvec4 place = PHOTONS(2u * index);
        vec3 chord = bits_float(uvec3(place)) - q.p;
        uvec4 carried = PHOTONS(2u * index + 1u);
        if (is_area) {
            real area = open_area(q, carried);
            coverage += area * weight;
            equal_area += area;
            add_area(q.moments, area, chord);
        } else if (caustics && photon_is_caustic(place.w)) {
            caustic += scattered(q, carried).radiance * weight;
        } else {
            Scattered light = scattered(q, carried);
            indirect += light.radiance * weight;
            equal_flux += light.radiance;
            add_flux(q.moments, light.radiance, light.weight, chord, dot3(chord, chord));
        }
    }
    real density = kernel_scale * inverse_r2;
    real trust = trusted_share(params.samples_per_area * PI * r2, nearest_trusted_samples);
    real known = known_coverage(q.p, coverage * density);
    real scale = mix(real(1.0), answer_scale(known), trust);
    store_estimate(q.slot, scale * density * indirect, scale * density * caustic,
                   mix(real(1.0), known, trust),
                   trust * known_unevenness(q.p, q.moments, equal_flux, equal_area));
    if (params.part == map_caustic) {
        caustic_discs[q.slot] = r2;
    }
    s.low = last_bits;
    s.phase = nearest_done;
}

FN void put_aside(uint place, Query q, Search s) {
    NearestRecord r;
    r.phase = s.phase;
    r.low = s.low;
    r.high = s.high;
    r.shift = s.shift;
    r.top = s.top;
    r.total = s.total;
    r.node = q.node;
    r.start = s.start;
    r.stop = s.stop;
    r.missing = s.missing;
    r.taken = s.taken;
    r.listed = s.listed;
    r.last = s.last;
    r.coverage = q.coverage;
    r.coverage_moment = s.coverage_moment;
    r.overflown = s.overflown ? 1u : 0u;
    r.indirect = vec4(q.indirect.value, q.moments.weight_square);
    r.indirect_compensation = vec4(q.indirect.compensation, real(0.0));
    r.caustic = vec4(q.caustic.value, real(0.0));
    r.caustic_compensation = vec4(q.caustic.compensation, real(0.0));
    r.indirect_moment = vec4(s.indirect_moment.value, real(0.0));
    r.indirect_moment_compensation = vec4(s.indirect_moment.compensation, real(0.0));
    r.flux_moments = vec4(q.moments.flux_offset, q.moments.square);
    r.area_moments = vec4(q.moments.area_offset, q.moments.weight);
    r.caustic_moment = vec4(s.caustic_moment.value, real(0.0));
    r.caustic_moment_compensation = vec4(s.caustic_moment.compensation, real(0.0));
    states[place] = r;
    for (uint i = 0u; i < nearest_words; ++i) {
        suspended_words[i * params.places + place] = WORD(i);
    }
}

FN void resume(uint place, INOUT(Query) q, OUT(Search) s) {
    NearestRecord r = states[place];
    s.phase = r.phase;
    s.low = r.low;
    s.high = r.high;
    s.shift = r.shift;
    s.top = r.top;
    s.total = r.total;
    q.node = r.node;
    s.start = r.start;
    s.stop = r.stop;
    s.missing = r.missing;
    s.taken = r.taken;
    s.listed = r.listed;
    s.last = r.last;
    q.coverage = r.coverage;
    q.moments = Moments(vec3(r.flux_moments), r.flux_moments.w, vec3(r.area_moments),
                        r.area_moments.w, r.indirect.w);
    s.coverage_moment = r.coverage_moment;
    s.overflown = r.overflown != 0u;
    q.indirect = Sum(vec3(r.indirect), vec3(r.indirect_compensation));
    q.caustic = Sum(vec3(r.caustic), vec3(r.caustic_compensation));
    s.indirect_moment = Sum(vec3(r.indirect_moment), vec3(r.indirect_moment_compensation));
    s.caustic_moment = Sum(vec3(r.caustic_moment), vec3(r.caustic_moment_compensation));
    for (uint i = 0u; i < nearest_words; ++i) {
        WORD(i) = suspended_words[i * params.places + place];
    }
}

FN void main() {
    uint place = THREAD_INDEX;
    uint i = params.first_query + place;
    if (i >= counts[params.count_index] || (params.places > 0u && place >= params.places)) {
        return;
    }
    if (params.first == 0u && states[place].phase == nearest_done) {
        return;
    }
    Query q = make_query(active_slots[i]);
    q.node = first_node(params.part); // also where walks end
    Search s;
    uint steps = 0u;
    if (params.first != 0u) {
        start_counting(q, s, steps);
    } else {
        resume(place, q, s);
    }
    bool ended;
    for (;;) {
        ended = true;
        // All lanes of a subgroup count first; then all of them add up.
        while (ended && s.phase == nearest_counts) {
            ended = count_photons(q, s, steps);
            if (ended) {
                judge_count(q, s);
            }
        }
        ended = ended && sum_photons(q, s, steps);
        if (!ended || !s.overflown) {
            break;
        }
        // The candidates include too many area samples.
        zoom(q, s, s.low, s.high);
    }
    if (ended) {
        finish(q, s);
    } else {
        atomicAdd(unfinished[0], 1u);
    }
    if (params.places > 0u) {
        put_aside(place, q, s);
    }
}
