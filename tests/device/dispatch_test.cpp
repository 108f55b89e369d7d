#include "base/error.hpp"
#include "device_fixture.hpp"
#include "kernels/add_neighbour.hpp"
#include "kernels/mark_threads.hpp"

namespace argand {
namespace {

using Words = std::vector<std::uint32_t>;

class Dispatch : public DeviceTest {
protected:
    void SetUp() override {
        if (!runs(kernels::mark_threads::info)) {
            GTEST_SKIP() << "mark_threads has no twin";
        }
    }
    /// Visits per index, after `run` received a buffer of `n` zeros.
    template <class Run> static Words visits(Device& device, std::size_t n, const Run& run) {
        const Buffer buffer = upload(device, "visits", Words(n, 0));
        run(kernels::mark_threads{.visits = buffer});
        return download<std::uint32_t>(device, buffer, n);
    }
};

TEST_F(Dispatch, VisitsEachIndexOnce) {
    Device& device = open_anew();
    for (const std::uint32_t n :
         {1u, 7u, 8u, 9u, 1000u, 600'000u}) { // the last one needs more than 65,535 groups
        SCOPED_TRACE(n);
        EXPECT_EQ(visits(device, n, [&](const auto& kernel) { dispatch(device, kernel, n); }),
                  Words(n, 1));
    }
}

TEST_F(Dispatch, WithoutThreadsDoesNothing) {
    Device& device = open_anew();
    EXPECT_EQ(visits(device, 100, [&](const auto& kernel) { dispatch(device, kernel, 0); }),
              Words(100, 0));
}

TEST_F(Dispatch, SpillsIntoFurtherDimensions) {
    Device& device = open_anew({"few groups", "", "groups=5"});
    for (const std::uint32_t n :
         {40u, 41u, 199u, 200u, 201u, 1000u}) { // 5, 6, 25, 25, 26 and 125 groups
        SCOPED_TRACE(n);
        EXPECT_EQ(visits(device, n, [&](const auto& kernel) { dispatch(device, kernel, n); }),
                  Words(n, 1));
    }
}

TEST_F(Dispatch, IndirectRunsTheCountedThreads) {
    for (const char* limit : {"", "groups=300"}) {
        Device& device = open_anew({"indirect", "", limit});
        constexpr std::uint32_t n = 100'000;
        for (const std::uint32_t count : {0u, 1u, 8u, 9u, 2400u, 2401u, 50'000u, n}) {
            SCOPED_TRACE(testing::Message() << count << " threads, limit " << limit);
            const Buffer counts = upload(device, "counts", Words{n, count});
            const Words visited = visits(device, n, [&](const auto& kernel) {
                dispatch_indirect(device, kernel, counts, 1);
            });
            // A group has 8 threads. Spilling rounds up to whole rows; kernels compare the surplus
            // with the count.
            EXPECT_EQ(Words(visited.begin(), visited.begin() + count), Words(count, 1));
            const std::uint32_t row = *limit ? 2400 : 8;
            const std::uint32_t end = std::min(n, (count + row - 1) / row * row);
            EXPECT_EQ(Words(visited.begin() + end, visited.end()), Words(n - end, 0));
        }
    }
}

TEST_F(Dispatch, IndirectSpillsIntoFurtherDimensions) {
    Device& device = open_anew({"few groups", "", "groups=5"});
    constexpr std::uint32_t n = 1000; // 125 groups of 8, the maximum
    for (const std::uint32_t count : {0u, 40u, 41u, 200u, 201u, 399u, 401u, 999u, n}) {
        SCOPED_TRACE(count);
        const Buffer counts = upload(device, "counts", Words{count});
        const Words visited = visits(
            device, n, [&](const auto& kernel) { dispatch_indirect(device, kernel, counts); });
        EXPECT_EQ(Words(visited.begin(), visited.begin() + count), Words(count, 1));
        // Whole groups, rows of 5 groups, slices of 25.
        const std::uint32_t whole = count > 200 ? 200 : count > 40 ? 40 : 8;
        const std::uint32_t end = (count + whole - 1) / whole * whole;
        EXPECT_EQ(Words(visited.begin() + end, visited.end()), Words(n - end, 0));
    }
}

TEST_F(Dispatch, IndirectReadsCountsThatKernelsWrote) {
    Device& device = open_anew();
    constexpr std::uint32_t n = 5000;
    const Buffer counts = upload(device, "counts", Words{500});
    Words expected(n, 0);
    EXPECT_EQ(visits(device, n,
                     [&](const auto& kernel) {
                         for (std::uint32_t i = 0; i < 3; ++i) {
                             dispatch_indirect(device, kernel, counts);
                             device.fill(counts, (i + 1) * 1000);
                             for (std::uint32_t k = 0; k < (i == 0 ? 504 : i * 1000); ++k) {
                                 ++expected[k];
                             }
                         }
                     }),
              expected);
}

TEST_F(Dispatch, IndirectDispatchesMayExceedTheRingOfCounts) {
    Device& device = open_anew();
    const Buffer counts = upload(device, "counts", Words{16});
    EXPECT_EQ(visits(device, 32,
                     [&](const auto& kernel) {
                         for (int i = 0; i < 1500; ++i) {
                             dispatch_indirect(device, kernel, counts);
                         }
                     }),
              [] {
                  Words expected(32, 0);
                  std::fill_n(expected.begin(), 16, 1500u);
                  return expected;
              }());
}

class Barriers : public DeviceTest, public testing::WithParamInterface<DeviceSetting> {
protected:
    void SetUp() override {
        if (!runs(kernels::add_neighbour::info)) {
            GTEST_SKIP() << "add_neighbour has no twin";
        }
    }
};

/// Reference for add_neighbour.
Words with_neighbours(const Words& values) {
    Words result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        result[i] = values[i] + values[(i + values.size() - 1) % values.size()];
    }
    return result;
}

TEST_P(Barriers, DependentDispatchesSeeEachOther) {
    Device& device = open_anew(GetParam());
    Words expected(3000);
    for (std::uint32_t i = 0; i < expected.size(); ++i) {
        expected[i] = i;
    }
    const Buffer a = upload(device, "a", expected);
    const Buffer b = device.allocate("b", a.size());
    for (int i = 0; i < 100; ++i) {
        dispatch(device, kernels::add_neighbour{.from_values = a, .to_values = b}, expected.size());
        dispatch(device, kernels::add_neighbour{.from_values = b, .to_values = a}, expected.size());
        expected = with_neighbours(with_neighbours(expected));
        if (i % 10 == 9) {
            device.submit(); // more submissions than may be in flight
        }
    }
    EXPECT_EQ(download<std::uint32_t>(device, a, expected.size()), expected);
}

TEST_P(Barriers, TransfersAndDispatchesSeeEachOther) {
    Device& device = open_anew(GetParam());
    constexpr std::size_t n = 20'000;
    const Buffer a = upload(device, "a", Words(n, 1));
    const Buffer b = upload(device, "b", Words(n, 2));
    dispatch(device, kernels::add_neighbour{.from_values = a, .to_values = b}, n); // b = 2
    device.fill(a, 5);                       // must happen after the read
    device.copy(b, BufferView(a, 0, n * 2)); // a = 2 | 5
    dispatch(device, kernels::add_neighbour{.from_values = a, .to_values = b},
             n); // b = 4 | 10, 7 at edges
    const Words nines(n, 9);
    device.upload(a, 0, std::as_bytes(std::span(nines)));
    dispatch(device, kernels::mark_threads{.visits = b}, n);
    Words expected(n, 11);
    std::fill_n(expected.begin(), n / 2, 5u);
    expected[0] = expected[n / 2] = 8;
    EXPECT_EQ(download<std::uint32_t>(device, b, n), expected);
    EXPECT_EQ(download<std::uint32_t>(device, a, n), nines);
}

INSTANTIATE_TEST_SUITE_P(Settings, Barriers,
                         testing::Values(DeviceSetting{"default", "", ""},
                                         DeviceSetting{"no_push_descriptors", "push_descriptors",
                                                       ""}),
                         [](const auto& setting) { return setting.param.name; });

TEST_F(Dispatch, ALargerGroupThanTheDeviceAllowsIsAnError) {
    Device& device = open_anew();
    KernelInfo wide = kernels::mark_threads::info;
    wide.local_size[0] = device.info().limits.invocations + 1;
    const Buffer visits = device.allocate("visits", 64);
    EXPECT_THROW(device.dispatch(wide, kernels::mark_threads{.visits = visits}.arguments(), 1),
                 Error);
}

} // namespace
} // namespace argand
