#include "parallel/radix_sort.hpp"

#include "device_fixture.hpp"
#include "parallel/elements.hpp"

#include <algorithm>
#include <numeric>

namespace argand {
namespace {

using Keys64 = std::vector<std::uint64_t>;

struct Distribution {
    const char* name;
    Elements (*keys)(std::uint32_t n);
};

Elements sorted(Elements keys) {
    std::sort(keys.begin(), keys.end());
    return keys;
}

Elements reversed(Elements keys) {
    std::sort(keys.rbegin(), keys.rend());
    return keys;
}

const std::vector<Distribution>& distributions() {
    static const std::vector<Distribution> all{
        {"random", [](std::uint32_t n) { return random_elements(n); }},
        {"equal", [](std::uint32_t n) { return Elements(n, 0xdeadbeef); }},
        {"all ones", [](std::uint32_t n) { return Elements(n, 0xffffffff); }},
        {"sorted", [](std::uint32_t n) { return sorted(random_elements(n)); }},
        {"reversed", [](std::uint32_t n) { return reversed(random_elements(n)); }},
        {"few distinct", [](std::uint32_t n) { return random_elements(n, 3); }},
        {"consecutive", [](std::uint32_t n) {
             Elements keys(n);
             std::iota(keys.begin(), keys.end(), 0u);
             return keys;
         }}};
    return all;
}

Elements counted(std::size_t n) {
    Elements values(n);
    std::iota(values.begin(), values.end(), 0u);
    return values;
}

/// Where the elements of a stable sort by the keys' lowest bits come from; the first `count` are
/// sorted.
template <class Key>
Elements sorted_order(const std::vector<Key>& keys, std::size_t count, std::uint32_t bits) {
    const Key mask = bits < 8 * sizeof(Key) ? (Key(1) << bits) - 1 : ~Key(0);
    Elements order = counted(keys.size());
    std::stable_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
        [&](std::uint32_t a, std::uint32_t b) { return (keys[a] & mask) < (keys[b] & mask); });
    return order;
}

template <class T> std::vector<T> gathered(const std::vector<T>& elements, const Elements& order) {
    std::vector<T> result(order.size());
    std::transform(order.begin(), order.end(), result.begin(),
                   [&](std::uint32_t i) { return elements[i]; });
    return result;
}

class RadixSort : public VariantTest {};

/// Sorts keys alone and with values, and compares with a stable sort.
void expect_sorts(Device& device, const Elements& keys, std::size_t n, const Count& count,
                  std::uint32_t bits = 32) {
    const Elements order = sorted_order(keys, n, bits);
    const Buffer alone = upload(device, "keys", keys);
    radix_sort(device, alone, count, bits);
    EXPECT_TRUE(download<std::uint32_t>(device, alone, keys.size()) == gathered(keys, order))
        << "keys alone";

    const Buffer paired = upload(device, "paired keys", keys);
    const Buffer values = upload(device, "values", counted(keys.size()));
    radix_sort_pairs(device, paired, values, count, bits);
    EXPECT_TRUE(download<std::uint32_t>(device, paired, keys.size()) == gathered(keys, order))
        << "keys of pairs";
    EXPECT_TRUE(download<std::uint32_t>(device, values, keys.size()) == order) << "values of pairs";
}

void expect_sorts64(Device& device, const Keys64& keys, std::size_t n, const Count& count,
                    std::uint32_t bits = 64) {
    const Elements order = sorted_order(keys, n, bits);
    const Buffer sorted_keys = upload(device, "keys", keys);
    const Buffer values = upload(device, "values", counted(keys.size()));
    radix_sort_pairs64(device, sorted_keys, values, count, bits);
    EXPECT_TRUE(download<std::uint64_t>(device, sorted_keys, keys.size()) == gathered(keys, order))
        << "keys";
    EXPECT_TRUE(download<std::uint32_t>(device, values, keys.size()) == order) << "values";
}

Keys64 random_keys64(std::size_t n) {
    const Elements low = random_elements(n, 0, 1);
    const Elements high = random_elements(n, 0, 2);
    Keys64 keys(n);
    for (std::size_t i = 0; i < n; ++i) {
        keys[i] = std::uint64_t(high[i]) << 32 | low[i];
    }
    return keys;
}

constexpr std::uint32_t largest_quick = 300'000;

TEST_P(RadixSort, EqualsAStableSortForAllSizes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        if (n <= largest_quick) {
            SCOPED_TRACE(n);
            expect_sorts(device, random_elements(n), n, n);
        }
    }
}

TEST_P(RadixSort, AllDistributions) {
    Device& device = open_variant();
    for (const Distribution& distribution : distributions()) {
        for (const std::uint32_t n : {2u, 1919u, 1921u, 100003u}) {
            SCOPED_TRACE(testing::Message() << distribution.name << " " << n);
            expect_sorts(device, distribution.keys(n), n, n);
        }
    }
}

TEST_P(RadixSort, LooksAtTheLowestBitsOnly) {
    Device& device = open_variant();
    for (const std::uint32_t bits : {0u, 1u, 5u, 8u, 9u, 16u, 21u, 24u, 30u, 31u, 32u}) {
        SCOPED_TRACE(bits);
        expect_sorts(device, random_elements(5000), 5000, 5000, bits);
    }
    for (const std::uint32_t bits : {3u, 32u, 33u, 40u, 57u, 64u}) {
        SCOPED_TRACE(bits);
        expect_sorts64(device, random_keys64(5000), 5000, 5000, bits);
    }
}

TEST_P(RadixSort, CountFromTheDeviceLeavesTheRestAlone) {
    Device& device = open_variant();
    for (const std::uint32_t bound : {2u, 7u, 40001u}) {
        for (const std::uint32_t n : {0u, 1u, 2u, bound / 3, bound - 1, bound, bound + 1}) {
            for (const std::uint32_t bits : {32u, 24u}) {
                SCOPED_TRACE(testing::Message()
                             << n << " of at most " << bound << ", " << bits << " bits");
                const Count count(upload(device, "counts", Elements{n}), 0, bound);
                expect_sorts(device, random_elements(bound), std::min(n, bound), count, bits);
                expect_sorts64(device, random_keys64(bound), std::min(n, bound), count, bits);
            }
        }
    }
}

TEST_P(RadixSort, Keys64) {
    Device& device = open_variant();
    for (const std::uint32_t n : {0u, 1u, 2u, 3u, 5u, 1919u, 1920u, 1921u, 65537u, 300007u}) {
        SCOPED_TRACE(n);
        expect_sorts64(device, random_keys64(n), n, n);
    }
    Keys64 few = random_keys64(50000);
    for (std::uint64_t& key : few) {
        key &= 0x0000000300000001ull;
    }
    expect_sorts64(device, few, few.size(), few.size());
}

/// The lanes of a serial sort read ten million elements in more steps than lavapipe allows a loop.
/// A group reads few tiles, whatever their number, and takes long for it on a CPU.
std::uint32_t large_size_for(const Device& device) {
    return device.info().lane_serial() ? large_size : size_beyond_the_groups;
}

TEST_P(RadixSort, SlowMillions) {
    Device& device = open_variant();
    const std::uint32_t n = large_size_for(device);
    expect_sorts(device, random_elements(n), n, n);
    expect_sorts(device, random_elements(n, 5), n, n);
    constexpr std::uint32_t million = 1 << 20;
    expect_sorts(device, random_elements(million), million, million);
}

TEST_P(RadixSort, SlowMillionsOfKeys64) {
    Device& device = open_variant();
    const std::uint32_t n = large_size_for(device);
    expect_sorts64(device, random_keys64(n), n, n);
}

INSTANTIATE_VARIANTS(RadixSort);

} // namespace
} // namespace argand
