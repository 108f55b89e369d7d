#include "device_fixture.hpp"
#include "parallel/elements.hpp"
#include "parallel/scan.hpp"

#include <algorithm>

namespace argand {
namespace {

Elements expected_scan(const Elements& in, const Elements& heads, std::size_t count) {
    Elements out(in.size(), untouched);
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        sum = heads[i] != 0 ? in[i] : sum + in[i];
        out[i] = sum;
    }
    return out;
}

class SegmentedScan : public VariantTest {
protected:
    static void expect_scan(Device& device, const Elements& in, const Elements& heads,
                            std::size_t n, const Count& count) {
        const Buffer out = upload(device, "out", Elements(in.size(), untouched));
        segmented_scan(device, upload(device, "in", in), upload(device, "heads", heads), out,
                       count);
        EXPECT_TRUE(download<std::uint32_t>(device, out, in.size()) == expected_scan(in, heads, n));
    }
};

TEST_P(SegmentedScan, RandomHeadsForAllSizes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        for (const std::uint32_t mean_length : {2u, 1000u}) {
            SCOPED_TRACE(testing::Message() << n << " elements, mean length " << mean_length);
            Elements heads = random_elements(n, mean_length, 2);
            std::transform(heads.begin(), heads.end(), heads.begin(),
                           [](std::uint32_t x) { return x == 0 ? 0x80000000u : 0u; });
            expect_scan(device, random_elements(n), heads, n, n);
        }
    }
}

TEST_P(SegmentedScan, SegmentsOfLengthOneAndAll) {
    Device& device = open_variant();
    for (const std::uint32_t n : {1u, 513u, 4097u, 200003u}) {
        SCOPED_TRACE(n);
        const Elements in = random_elements(n);
        expect_scan(device, in, Elements(n, 1), n, n);
        Elements heads(n, 0);
        expect_scan(device, in, heads, n, n); // the first element starts a segment in any case
        heads[0] = 1;
        expect_scan(device, in, heads, n, n);
        heads[n - 1] = 7;
        heads[n / 2] = 7;
        expect_scan(device, in, heads, n, n);
    }
}

TEST_P(SegmentedScan, InPlace) {
    Device& device = open_variant();
    constexpr std::uint32_t n = 50021;
    const Elements in = random_elements(n);
    const Elements heads = random_elements(n, 2, 2);
    const Buffer buffer = upload(device, "elements", in);
    segmented_scan(device, buffer, upload(device, "heads", heads), buffer, n);
    EXPECT_TRUE(download<std::uint32_t>(device, buffer, n) == expected_scan(in, heads, n));
}

TEST_P(SegmentedScan, CountFromTheDeviceLeavesTheRestAlone) {
    Device& device = open_variant();
    for (const std::uint32_t bound : {1u, 700u, 60013u}) {
        const Elements in = random_elements(bound);
        const Elements heads = random_elements(bound, 2, 2);
        for (const std::uint32_t n : {0u, 1u, bound / 3, bound - 1, bound, bound + 1}) {
            SCOPED_TRACE(testing::Message() << n << " of at most " << bound);
            const Buffer counts = upload(device, "counts", Elements{n});
            expect_scan(device, in, heads, std::min(n, bound), Count(counts, 0, bound));
        }
    }
}

TEST_P(SegmentedScan, SlowTenMillion) {
    expect_scan(open_variant(), random_elements(large_size), random_elements(large_size, 2, 2),
                large_size, large_size);
}

INSTANTIATE_VARIANTS(SegmentedScan);

} // namespace
} // namespace argand
