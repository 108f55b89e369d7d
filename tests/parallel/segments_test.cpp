// Boxes, partitions and copies of segments, against serial loops.
#include "parallel/segments.hpp"

#include "base/error.hpp"
#include "device_fixture.hpp"
#include "parallel/elements.hpp"
#include "shared/geometry_records.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace argand {
namespace {

constexpr std::uint32_t largest_quick = 70'000;
constexpr std::uint32_t slow_size = 1u << 24;

/// Elements in segments, some in none.
struct Layout {
    Elements of_elements;
    std::vector<SegmentRange> ranges;
};

/// Segments of this mean length, at least 1. gaps: whether some runs of elements are in no segment.
Layout random_layout(std::uint32_t n, std::uint32_t mean_length, bool gaps) {
    std::mt19937 random(n + mean_length);
    Layout layout{.of_elements = Elements(n, no_segment), .ranges = {}};
    for (std::uint32_t i = 0; i < n;) {
        const auto wanted = static_cast<std::uint32_t>(1 + random() % (2 * mean_length - 1));
        const std::uint32_t length = std::min(wanted, n - i);
        if (!gaps || random() % 4 > 0) {
            const auto segment = static_cast<std::uint32_t>(layout.ranges.size());
            std::fill_n(layout.of_elements.begin() + i, length, segment);
            layout.ranges.push_back({i, length});
        }
        i += length;
    }
    return layout;
}

std::vector<Layout> layouts(std::uint32_t n) {
    return {random_layout(n, 1, false),
            random_layout(n, 9, true),
            random_layout(n, 1000, true),
            {.of_elements = Elements(n, 0), .ranges = {{0, n}}},
            {.of_elements = Elements(n, no_segment), .ranges = {{0, 1}}}};
}

Segments upload_segments(Device& device, const Layout& layout, std::uint32_t first,
                         std::uint32_t end) {
    return {.of_elements = upload(device, "segments", layout.of_elements),
            .ranges = upload(device, "ranges", layout.ranges),
            .first = first,
            .end = end};
}

/// Floats of all magnitudes and both signs, zeros and infinities.
std::vector<float> some_floats() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::vector<float> floats{0,         -0.0f,   infinity, -infinity, 1.2e-38f,
                              -1.2e-38f, 3.4e38f, -3.4e38f, 1,         -1};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> exponent(-37.9, 38.5);
    while (floats.size() < 1021) {
        const auto x = static_cast<float>(std::pow(10.0, exponent(random)));
        floats.push_back(random() % 2 == 0 ? x : -x);
    }
    return floats;
}

std::vector<glm::vec4> random_points(std::size_t n) {
    static const std::vector<float> floats = some_floats();
    std::mt19937 random(7);
    // One point in four has small positive coordinates, so that corners are of either sign.
    const auto coordinate = [&](bool small) {
        return small ? static_cast<float>(random() % 1000) : floats[random() % floats.size()];
    };
    std::vector<glm::vec4> points(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool small = i / 64 % 4 == 0;
        points[i] = {coordinate(small), coordinate(small), coordinate(small), coordinate(false)};
    }
    return points;
}

struct Corners {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};
    bool empty = true;
};

/// lanes: words of four in an element, the first its lower corner and the last its upper one.
std::vector<Corners> expected_boxes(const std::vector<glm::vec4>& elements, std::size_t lanes,
                                    const Layout& layout, std::uint32_t first, std::uint32_t end,
                                    std::size_t count) {
    std::vector<Corners> boxes(count);
    for (std::size_t i = first; i < end; ++i) {
        if (layout.of_elements[i] != no_segment) {
            Corners& box = boxes[layout.of_elements[i]];
            box.low = glm::min(box.low, glm::vec3(elements[lanes * i]));
            box.high = glm::max(box.high, glm::vec3(elements[lanes * i + lanes - 1]));
            box.empty = false;
        }
    }
    return boxes;
}

class Segmented : public VariantTest {
protected:
    /// The elements first <= i < end. Segments beyond those of the layout are empty.
    static void expect_boxes(Device& device, const Layout& layout, Lanes lanes, std::uint32_t first,
                             std::uint32_t end) {
        const auto stride = static_cast<std::size_t>(lanes);
        const std::vector<glm::vec4> elements = random_points(stride * layout.of_elements.size());
        const auto count = static_cast<std::uint32_t>(layout.ranges.size() + 3);
        const Buffer boxes =
            upload(device, "boxes", Elements((count + 1) * sizeof(BoxRecord) / 4, untouched));
        segment_boxes(device, upload(device, "elements", elements), lanes,
                      upload_segments(device, layout, first, end), count, boxes);
        const auto found = download<glm::vec4>(device, boxes, 2 * (std::size_t(count) + 1));
        const auto expected = expected_boxes(elements, stride, layout, first, end, count);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 low(found[2 * i]);
            const glm::vec3 high(found[2 * i + 1]);
            wrong += expected[i].empty ? !glm::all(glm::greaterThan(low, high))
                                       : low != expected[i].low || high != expected[i].high;
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_EQ(download_word(device, boxes, count * sizeof(BoxRecord) / 4), untouched);
    }

    /// The elements first <= i < end, which are whole segments.
    static void expect_partition(Device& device, const Layout& layout, const Elements& flags,
                                 std::uint32_t first, std::uint32_t end) {
        const std::size_t n = flags.size();
        const Buffer places = upload(device, "places", Elements(n, untouched));
        const Buffer lefts = upload(device, "lefts", Elements(layout.ranges.size(), untouched));
        partition_segments(device, upload(device, "flags", flags),
                           upload_segments(device, layout, first, end),
                           upload(device, "sums", Elements(n, untouched)), places, lefts);
        Elements expected(n, untouched);
        std::iota(expected.begin() + first, expected.begin() + end, first);
        Elements expected_lefts(layout.ranges.size(), untouched);
        for (std::size_t k = 0; k < layout.ranges.size(); ++k) {
            const SegmentRange range = layout.ranges[k];
            if (range.first < first || range.first >= end || layout.of_elements[range.first] != k) {
                continue;
            }
            std::uint32_t place = range.first;
            for (const bool left : {true, false}) {
                for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
                    if ((flags[i] != 0) == left) {
                        expected[i] = place++;
                    }
                }
                expected_lefts[k] = left ? place - range.first : expected_lefts[k];
            }
        }
        EXPECT_TRUE(download<std::uint32_t>(device, places, n) == expected);
        EXPECT_TRUE(download<std::uint32_t>(device, lefts, expected_lefts.size()) ==
                    expected_lefts);
    }

    static void expect_copies(Device& device, const Elements& counts) {
        Elements expected;
        Elements firsts;
        firsts.reserve(counts.size());
        for (std::uint32_t i = 0; i < counts.size(); ++i) {
            firsts.push_back(static_cast<std::uint32_t>(expected.size()));
            expected.insert(expected.end(), counts[i], i);
        }
        const auto elements = static_cast<std::uint32_t>(counts.size());
        const auto copies = static_cast<std::uint32_t>(expected.size());
        const Buffer sums = upload(device, "sums", Elements(counts.size(), untouched));
        const Buffer sources = upload(device, "sources", Elements(copies + 1, untouched));
        expand(device, upload(device, "counts", counts), elements, copies, sums, sources);
        expected.push_back(untouched);
        EXPECT_TRUE(download<std::uint32_t>(device, sums, elements) == firsts);
        EXPECT_TRUE(download<std::uint32_t>(device, sources, copies + 1) == expected);
    }
};

TEST_P(Segmented, BoxesOfPointsAndBoxes) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        if (n > largest_quick) {
            continue; // the slow test is larger
        }
        for (const Layout& layout : layouts(n)) {
            SCOPED_TRACE(testing::Message() << n << " in " << layout.ranges.size());
            expect_boxes(device, layout, Lanes::point, 0, n);
            expect_boxes(device, layout, Lanes::box, 0, n);
        }
    }
}

TEST_P(Segmented, BoxesOfAPartOfTheElements) {
    Device& device = open_variant();
    for (const std::uint32_t n : {3u, 65u, 1009u, 9'001u}) {
        for (const Layout& layout : layouts(n)) {
            for (const std::uint32_t first : {0u, 1u, n / 3, n - 1}) {
                for (const std::uint32_t end : {first, first + 1, (first + n) / 2, n}) {
                    SCOPED_TRACE(testing::Message() << first << " to " << end << " of " << n);
                    expect_boxes(device, layout, Lanes::box, first, std::min(end, n));
                }
            }
        }
    }
}

// Segments need not be numbered in the order of their elements.
TEST_P(Segmented, BoxesOfSegmentsInAnyOrder) {
    Device& device = open_variant();
    Layout layout = random_layout(30'011, 40, true);
    Elements numbers(layout.ranges.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::shuffle(numbers.begin(), numbers.end(), std::mt19937(2));
    for (std::uint32_t& segment : layout.of_elements) {
        segment = segment == no_segment ? no_segment : numbers[segment];
    }
    expect_boxes(device, layout, Lanes::point, 0, 30'011);
}

TEST_P(Segmented, BoxesOfMoreThanThereIsRoomForAreAnError) {
    Device& device = open_variant();
    const Segments two = upload_segments(device, random_layout(2, 1, false), 0, 2);
    const Buffer elements = device.allocate("elements", 64);
    const Buffer small = device.allocate("boxes", 32);
    EXPECT_THROW(segment_boxes(device, elements, Lanes::point, two, 2, small), Error);
    EXPECT_THROW(segment_boxes(device, small, Lanes::box, two, 1, small), Error);
}

TEST_P(Segmented, PartitionsAreStable) {
    Device& device = open_variant();
    for (const std::uint32_t n : sizes()) {
        if (n > largest_quick) {
            continue;
        }
        for (const Layout& layout : layouts(n)) {
            SCOPED_TRACE(testing::Message() << n << " in " << layout.ranges.size());
            expect_partition(device, layout, random_elements(n, 2), 0, n);
        }
        expect_partition(device, random_layout(n, 20, true), Elements(n, 0), 0, n);
        expect_partition(device, random_layout(n, 20, true), Elements(n, 1), 0, n);
    }
}

TEST_P(Segmented, PartitionsOfAPartOfTheElements) {
    Device& device = open_variant();
    constexpr std::uint32_t n = 50'021;
    const Layout layout = random_layout(n, 30, true);
    const Elements flags = random_elements(n, 2, 3);
    const std::size_t last = layout.ranges.size() - 1;
    for (const std::size_t from : {std::size_t(0), std::size_t(1), last / 2, last}) {
        for (const std::size_t to : {from, from + 1, last}) {
            const SegmentRange end = layout.ranges[std::min(to, last)];
            SCOPED_TRACE(testing::Message() << from << " to " << to);
            expect_partition(device, layout, flags, layout.ranges[from].first,
                             end.first + end.count);
        }
    }
    const std::uint32_t middle = layout.ranges[last / 2].first;
    expect_partition(device, layout, flags, middle, middle);
}

TEST_P(Segmented, ExpandsByCounts) {
    Device& device = open_variant();
    expect_copies(device, {});
    for (const Elements& counts :
         {Elements{0}, Elements{1}, Elements{2}, Elements{100'003}, Elements{0, 0, 0},
          Elements{0, 0, 5, 0, 1, 0, 0}, Elements{0, 70'000, 0, 0, 0, 1, 65'535, 0}}) {
        SCOPED_TRACE(testing::PrintToString(counts));
        expect_copies(device, counts);
    }
    for (const std::uint32_t n : sizes()) {
        SCOPED_TRACE(n);
        expect_copies(device, random_elements(n, 3));
    }
    // Few elements with copies, zeros at both ends.
    Elements sparse(20'011, 0);
    for (std::size_t i = 500; i < 19'000; i += 701) {
        sparse[i] = static_cast<std::uint32_t>(i);
    }
    expect_copies(device, sparse);
}

TEST_P(Segmented, SlowSixteenMillion) {
    Device& device = open_variant();
    const auto room = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(slow_size, device.info().limits.storage_range / sizeof(glm::vec4)));
    expect_boxes(device, random_layout(room, 50, true), Lanes::point, 0, room);
    expect_partition(device, random_layout(slow_size, 1000, true), random_elements(slow_size, 2), 0,
                     slow_size);
    expect_copies(device, random_elements(slow_size, 3));
}

INSTANTIATE_VARIANTS(Segmented);

} // namespace
} // namespace argand
