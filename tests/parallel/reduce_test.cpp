#include "parallel/reduce.hpp"

#include "device_fixture.hpp"
#include "parallel/elements.hpp"
#include "shared/geometry_records.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace argand {
namespace {

class Reduce : public VariantTest {};

void expect_reductions(Device& device, const Elements& in, std::size_t n, const Count& count) {
    const auto end = in.begin() + static_cast<std::ptrdiff_t>(n);
    const Buffer from = upload(device, "in", in);
    const Buffer out = upload(device, "out", Elements{7, 7, 7, 7, 7});
    reduce_sum(device, from, out, 1, count);
    reduce_min(device, from, out, 2, count);
    reduce_max(device, from, out, 3, count);
    EXPECT_EQ(download<std::uint32_t>(device, out, 5),
              (Elements{7, std::accumulate(in.begin(), end, 0u),
                        n > 0 ? *std::min_element(in.begin(), end) : 0xffffffffu,
                        n > 0 ? *std::max_element(in.begin(), end) : 0u, 7}));
}

TEST_P(Reduce, EqualsTheStandardLibraryForAllSizes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        SCOPED_TRACE(n);
        expect_reductions(device, random_elements(n), n, n);
    }
}

TEST_P(Reduce, ExtremesInTheLastElement) {
    Device& device = open_variant();
    for (const std::uint32_t n : {1u, 2u, 513u, 100003u}) {
        Elements in(n, 1000);
        in.back() = 3;
        expect_reductions(device, in, n, n);
        in.back() = 0xffffffffu;
        expect_reductions(device, in, n, n);
    }
}

TEST_P(Reduce, CountFromTheDevice) {
    Device& device = open_variant();
    constexpr std::uint32_t bound = 100003;
    for (const std::uint32_t count : {0u, 1u, 5u, 4096u, bound - 1, bound, bound + 1}) {
        SCOPED_TRACE(count);
        const Buffer counts = upload(device, "counts", Elements{0, count});
        expect_reductions(device, random_elements(bound), std::min(count, bound),
                          Count(counts, 1, bound));
    }
}

TEST_P(Reduce, SlowTenMillion) {
    expect_reductions(open_variant(), random_elements(large_size), large_size, large_size);
}

std::vector<BoxRecord> random_boxes(std::size_t n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-1e6f, 1e6f);
    std::vector<BoxRecord> boxes(n);
    for (BoxRecord& box : boxes) {
        box = {at(random), at(random), at(random), 0, at(random), at(random), at(random), 0};
    }
    return boxes;
}

BoxRecord expected_box(const std::vector<BoxRecord>& boxes, std::size_t count) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    BoxRecord all{infinity, infinity, infinity, 0, -infinity, -infinity, -infinity, 0};
    for (std::size_t i = 0; i < count; ++i) {
        all.low_x = std::min(all.low_x, boxes[i].low_x);
        all.low_y = std::min(all.low_y, boxes[i].low_y);
        all.low_z = std::min(all.low_z, boxes[i].low_z);
        all.high_x = std::max(all.high_x, boxes[i].high_x);
        all.high_y = std::max(all.high_y, boxes[i].high_y);
        all.high_z = std::max(all.high_z, boxes[i].high_z);
    }
    return all;
}

void expect_equal(const BoxRecord& a, const BoxRecord& b) {
    EXPECT_EQ(a.low_x, b.low_x);
    EXPECT_EQ(a.low_y, b.low_y);
    EXPECT_EQ(a.low_z, b.low_z);
    EXPECT_EQ(a.high_x, b.high_x);
    EXPECT_EQ(a.high_y, b.high_y);
    EXPECT_EQ(a.high_z, b.high_z);
}

TEST_P(Reduce, BoxOfBoxes) {
    Device& device = open_variant();
    const Buffer out = device.allocate("out", 3 * sizeof(BoxRecord));
    for (const std::uint32_t n : {0u, 1u, 2u, 127u, 129u, 2049u, 65537u, 200003u}) {
        SCOPED_TRACE(n);
        const std::vector<BoxRecord> boxes = random_boxes(n);
        const Buffer in = upload(device, "boxes", boxes);
        reduce_box(device, in, out, 2, n);
        expect_equal(download<BoxRecord>(device, out, 1, 2)[0], expected_box(boxes, n));
    }
}

TEST_P(Reduce, BoxWithCountFromTheDevice) {
    Device& device = open_variant();
    constexpr std::uint32_t bound = 10007;
    const std::vector<BoxRecord> boxes = random_boxes(bound);
    const Buffer in = upload(device, "boxes", boxes);
    const Buffer out = device.allocate("out", sizeof(BoxRecord));
    for (const std::uint32_t count : {0u, 1u, 4000u, bound}) {
        SCOPED_TRACE(count);
        const Buffer counts = upload(device, "counts", Elements{count});
        reduce_box(device, in, out, 0, Count(counts, 0, bound));
        expect_equal(download<BoxRecord>(device, out, 1)[0], expected_box(boxes, count));
    }
}

INSTANTIATE_VARIANTS(Reduce);

} // namespace
} // namespace argand
