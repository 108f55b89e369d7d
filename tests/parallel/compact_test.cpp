#include "parallel/compact.hpp"

#include "device_fixture.hpp"
#include "parallel/elements.hpp"

namespace argand {
namespace {

struct Kept {
    Elements values;
    std::uint32_t number = 0;
    bool operator==(const Kept&) const = default;
};

/// What is kept of the first `count`, followed by what was there before.
Kept expected_kept(const Elements& flags, const Elements& values, std::size_t count) {
    Kept kept{Elements(values.size(), untouched), 0};
    for (std::size_t i = 0; i < count; ++i) {
        if (flags[i] != 0) {
            kept.values[kept.number++] = values[i];
        }
    }
    return kept;
}

class Compact : public VariantTest {
protected:
    static Kept compacted(Device& device, const Elements& flags, const Elements& values,
                          const Count& count) {
        const Buffer out = upload(device, "out", Elements(values.size(), untouched));
        const Buffer counts = upload(device, "counts", Elements{untouched, untouched});
        compact(device, upload(device, "flags", flags), upload(device, "values", values), out,
                {counts, 1}, count);
        const Elements totals = download<std::uint32_t>(device, counts, 2);
        EXPECT_EQ(totals[0], untouched);
        return {download<std::uint32_t>(device, out, values.size()), totals[1]};
    }
};

TEST_P(Compact, KeepsFlaggedValuesInTheirOrderForAllSizes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        SCOPED_TRACE(n);
        const Elements values = random_elements(n, 0, 2);
        const Elements flags = random_elements(n, 3);
        EXPECT_EQ(compacted(device, flags, values, n), expected_kept(flags, values, n));
    }
}

TEST_P(Compact, AllNoneAndFew) {
    Device& device = open_variant();
    for (const std::uint32_t n : {1u, 4097u, 300007u}) {
        SCOPED_TRACE(n);
        const Elements values = random_elements(n, 0, 2);
        Elements few(n, 0);
        few[n / 2] = 0x80000000u;
        few[n - 1] = 1;
        for (const Elements& flags : {Elements(n, 1), Elements(n, 0), few}) {
            EXPECT_EQ(compacted(device, flags, values, n), expected_kept(flags, values, n));
        }
    }
}

TEST_P(Compact, CountFromTheDevice) {
    Device& device = open_variant();
    constexpr std::uint32_t bound = 70001;
    const Elements values = random_elements(bound, 0, 2);
    const Elements flags = random_elements(bound, 2);
    for (const std::uint32_t count : {0u, 1u, 6u, 5000u, bound - 1, bound, bound + 1}) {
        SCOPED_TRACE(count);
        const Buffer counts = upload(device, "counts", Elements{count});
        EXPECT_EQ(compacted(device, flags, values, Count(counts, 0, bound)),
                  expected_kept(flags, values, std::min(count, bound)));
    }
}

TEST_P(Compact, SlowTenMillion) {
    const Elements values = random_elements(large_size, 0, 2);
    const Elements flags = random_elements(large_size, 2);
    EXPECT_EQ(compacted(open_variant(), flags, values, large_size),
              expected_kept(flags, values, large_size));
}

INSTANTIATE_VARIANTS(Compact);

} // namespace
} // namespace argand
