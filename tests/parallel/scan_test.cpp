#include "parallel/scan.hpp"

#include "device_fixture.hpp"
#include "parallel/elements.hpp"

#include <numeric>

namespace argand {
namespace {

Elements expected_scan(const Elements& in, std::size_t count, bool inclusive) {
    Elements out(in.size(), untouched);
    const auto end = in.begin() + static_cast<std::ptrdiff_t>(count);
    if (inclusive) {
        std::inclusive_scan(in.begin(), end, out.begin());
    } else {
        std::exclusive_scan(in.begin(), end, out.begin(), 0u);
    }
    return out;
}

class Scan : public VariantTest {
protected:
    static void expect_scans(Device& device, const Elements& in) {
        const Buffer from = upload(device, "in", in);
        const Buffer to = upload(device, "out", Elements(in.size(), untouched));
        exclusive_scan(device, from, to, in.size());
        EXPECT_EQ(download<std::uint32_t>(device, to, in.size()),
                  expected_scan(in, in.size(), false));
        inclusive_scan(device, from, to, in.size());
        EXPECT_EQ(download<std::uint32_t>(device, to, in.size()),
                  expected_scan(in, in.size(), true));
        EXPECT_EQ(download<std::uint32_t>(device, from, in.size()), in);
    }
};

TEST_P(Scan, EqualsTheStandardLibraryForAllSizes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        SCOPED_TRACE(n);
        expect_scans(device, random_elements(n));
    }
}

TEST_P(Scan, SlowTenMillion) { expect_scans(open_variant(), random_elements(large_size)); }

TEST_P(Scan, InPlace) {
    Device& device = open_variant();
    for (const std::uint32_t n : {1u, 1000u, 4097u, 100003u}) {
        SCOPED_TRACE(n);
        const Elements in = random_elements(n);
        const Buffer buffer = upload(device, "elements", in);
        exclusive_scan(device, buffer, buffer, n);
        EXPECT_EQ(download<std::uint32_t>(device, buffer, n), expected_scan(in, n, false));
    }
}

TEST_P(Scan, CountFromTheDeviceLeavesTheRestAlone) {
    Device& device = open_variant();
    for (const std::uint32_t bound : {1u, 7u, 4096u, 50001u, 1000000u}) {
        const Elements in = random_elements(bound);
        const Buffer from = upload(device, "in", in);
        for (const std::uint32_t count : {0u, 1u, 2u, 3u, bound / 3, bound - 1, bound, bound + 5}) {
            SCOPED_TRACE(testing::Message() << count << " of at most " << bound);
            const Buffer counts = upload(device, "counts", Elements{99, 99, count});
            const Buffer to = upload(device, "out", Elements(bound, untouched));
            exclusive_scan(device, from, to, Count(counts, 2, bound));
            EXPECT_EQ(download<std::uint32_t>(device, to, bound),
                      expected_scan(in, std::min(count, bound), false));
        }
    }
}

TEST_P(Scan, ScansThatFollowEachOther) {
    Device& device = open_variant();
    constexpr std::uint32_t n = 20000;
    Elements expected = random_elements(n);
    const Buffer a = upload(device, "a", expected);
    const Buffer b = device.allocate("b", n * 4);
    for (int i = 0; i < 3; ++i) {
        inclusive_scan(device, a, b, n);
        exclusive_scan(device, b, a, n);
        std::inclusive_scan(expected.begin(), expected.end(), expected.begin());
        std::exclusive_scan(expected.begin(), expected.end(), expected.begin(), 0u);
    }
    EXPECT_EQ(download<std::uint32_t>(device, a, n), expected);
}

TEST_P(Scan, CountBeyondTheBufferIsAnError) {
    Device& device = open_variant();
    const Buffer small = device.allocate("small", 64);
    EXPECT_THROW(exclusive_scan(device, small, small, 17), std::runtime_error);
}

INSTANTIATE_VARIANTS(Scan);

} // namespace
} // namespace argand
