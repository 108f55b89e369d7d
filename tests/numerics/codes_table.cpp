#include "table.hpp"

#include "codes_functions.h"

namespace argand::testing {

namespace {

constexpr auto ulp = Measure::ulp;

/// A word of any length, including 0, single bits, and all bits set.
std::uint32_t any_word(Draw& d) {
    const auto word = static_cast<std::uint32_t>(d.bits());
    switch (d.bits() % 6) {
    case 0:
        return 0;
    case 1:
        return 0xffffffffu;
    case 2:
        return 1u << (word % 32);
    case 3:
        return word >> (d.bits() % 32);
    default:
        return word;
    }
}

/// Codes and places of two leaves that first differ in any of their 96 bits.
void put_leaves(Draw& d) {
    std::uint32_t first[3] = {any_word(d), any_word(d), any_word(d)};
    std::uint32_t second[3] = {any_word(d), any_word(d), any_word(d)};
    const unsigned bit = d.bits() % 96;
    for (unsigned k = 0; k < 3; ++k) { // the highest word first
        if (k == bit / 32) {
            const std::uint32_t flipped = 1u << (31 - bit % 32);
            const std::uint32_t below = flipped - 1;
            second[k] = ((first[k] ^ flipped) & ~below) | (second[k] & below);
            break;
        }
        second[k] = first[k];
    }
    for (const auto& leaf : {first, second}) {
        d.put_word(leaf[1]);
        d.put_word(leaf[0]);
    }
    d.put_word(first[2]);
    d.put_word(second[2]);
}

/// A point in or near a box, and the box's corners; includes flat boxes and boxes larger than the
/// greatest number.
void put_point_and_box(Draw& d) {
    glm::vec3 low = d.vector(-20, 20);
    glm::vec3 size = glm::abs(d.vector(-10, 20));
    if (d.once_in(4)) {
        size = glm::vec3(d.magnitude(-20, 0)) * glm::abs(low);
    }
    glm::vec3 high = low + size;
    if (d.once_in(6)) {
        const int axis = static_cast<int>(d.bits() % 3);
        low[axis] = static_cast<float>(-d.between(2e38, 3.3e38));
        high[axis] = static_cast<float>(d.between(2e38, 3.3e38));
    }
    glm::dvec3 share(d.unit(), d.unit(), d.unit());
    if (d.once_in(8)) {
        const int axis = static_cast<int>(d.bits() % 3);
        share[axis] = high[axis] > 1e38f ? d.between(0, 1.01) : share[axis] * 3 - 1;
    }
    d.put(rounded(glm::dvec3(low) + share * (glm::dvec3(high) - glm::dvec3(low))));
    d.put(low);
    d.put(high);
}

void put_photon_direction(Draw& d) {
    const float ends[] = {0, 62, 63, 64, 16777216};
    d.put(d.direction());
    d.put(d.once_in(3) ? ends[d.bits() % 5] : static_cast<float>(d.bits() % 100));
    d.put(static_cast<float>(d.bits() % 32));
}

} // namespace

std::vector<Function> codes_table() {
    return {
        {"add_compensated", of_add_compensated,
         "8 terms, 128 times over: 2^-20 … 2^20, zeros; numbers and vectors",
         [](Draw& d) {
             for (int i = 0; i < 32; ++i) {
                 d.put(std::abs(d.component(-20, 20)));
             }
         },
         0, "1111", ulp, 2},
        {"spread_bits", of_spread_bits, "any words", [](Draw& d) { d.put_word(any_word(d)); }, 0,
         "dd", ulp, 0},
        {"leading_zeros", of_leading_zeros, "any words", [](Draw& d) { d.put_word(any_word(d)); },
         0, "d", ulp, 0},
        {"code_distance", of_code_distance, "leaves that first differ in any bit of code and index",
         put_leaves, 0, "d", ulp, 0},
        {"morton30", of_morton30,
         "points in boxes and outside, boxes of 2^-20 of their distance from the origin, flat ones "
         "and ones larger than the largest number",
         put_point_and_box, 9, "dddd", ulp, 0, 0.025},
        {"morton63", of_morton63,
         "points in boxes and outside, boxes of 2^-20 of their distance from the origin, flat ones "
         "and ones larger than the largest number",
         put_point_and_box, 9, "dddd", ulp, 0, 0.2},
        {"pack_photon_direction, photon_scatterings, photon_rarity", of_pack_photon_direction,
         "directions, 0 … 2^24 scatterings, densities of 2^0 … 2^31", put_photon_direction, 3,
         "ccdd", ulp, 0},
        {"unpack_unit of pack_photon_direction: the direction", of_photon_direction_read,
         "directions, 0 … 2^24 scatterings, densities of 2^0 … 2^31", put_photon_direction, 3, "3",
         ulp, 50'332}, // 3e-3
        {"photon_is_caustic", of_photon_is_caustic,
         "directions, caustic or not, area samples or not",
         [](Draw& d) {
             d.put(d.direction());
             d.put(static_cast<float>(d.bits() % 2));
             d.put(static_cast<float>(d.bits() % 2));
         },
         3, "d", ulp, 0},
        {"eye_random4", of_eye_random4, "any words, dimensions 0 … 7, of a lattice or not",
         [](Draw& d) {
             for (int i = 0; i < 3; ++i) {
                 d.put_word(any_word(d));
             }
             d.put(static_cast<float>(d.bits() % 8));
             d.put(static_cast<float>(d.bits() % 2));
         },
         0, "dddd", ulp, 0},
        {"photon_random4", of_photon_random4, "any words, dimensions 0 … 7, all numbers_*",
         [](Draw& d) {
             d.put_word(any_word(d));
             d.put_word(any_word(d));
             d.put(static_cast<float>(d.bits() % 8));
             d.put(static_cast<float>(d.bits() % 3));
         },
         0, "dddd", ulp, 0},
        {"shuffled_slot, slot_of_shuffled", of_shuffled_slot, "any words",
         [](Draw& d) { d.put_word(any_word(d)); }, 0, "dddd", ulp, 0},
        {"part_size", of_part_size,
         "0 … 2^31 elements, whole parts ± 1 among them; 1 … 1,024 parts, grains 1 … 4,096",
         [](Draw& d) {
             const std::uint32_t parts = d.once_in(2)
                                             ? 1u << (d.bits() % 11)
                                             : static_cast<std::uint32_t>(1 + d.bits() % 1024);
             const std::uint32_t grain = d.once_in(2)
                                             ? 1u << (d.bits() % 13)
                                             : static_cast<std::uint32_t>(1 + d.bits() % 4096);
             const auto whole = static_cast<std::uint32_t>(1 + d.bits() % 100) * parts * grain;
             const auto beside = static_cast<std::uint32_t>(d.bits() % 3);
             d.put_word(d.once_in(2) ? whole + beside - 1 : any_word(d) >> 1);
             d.put(static_cast<float>(parts));
             d.put(static_cast<float>(grain));
         },
         0, "dd", ulp, 0},
    };
}

} // namespace argand::testing
