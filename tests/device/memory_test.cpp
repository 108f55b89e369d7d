#include "base/error.hpp"
#include "device_fixture.hpp"
#include "support/expect_error.hpp"

namespace argand {
namespace {

using argand::testing::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Memory : public DeviceTest {};

TEST_F(Memory, ReportsPeaksByName) {
    Device& device = open_anew();
    const std::uint64_t before = device.memory().current;
    {
        const Buffer a = device.allocate("photons", 1 << 20);
        {
            const Buffer b = device.allocate("photons", 1 << 21);
            EXPECT_GE(device.memory_by_name().at("photons").current, 3u << 20);
        }
        const Buffer c = device.allocate("nodes", 1 << 20);
        const MemoryUse photons = device.memory_by_name().at("photons");
        EXPECT_GE(photons.current, 1u << 20);
        EXPECT_LT(photons.current, 2u << 20);
        EXPECT_GE(photons.peak, 3u << 20);
        EXPECT_GE(device.memory_by_name().at("nodes").peak, 1u << 20);
    }
    EXPECT_EQ(device.memory_by_name().at("photons").current, 0u);
    EXPECT_EQ(device.memory_by_name().at("nodes").current, 0u);
    EXPECT_EQ(device.memory().current, before);
    EXPECT_GE(device.memory().peak, before + (3u << 20));
    EXPECT_LT(device.memory().peak, before + (5u << 20));
}

TEST_F(Memory, CopiesOfABufferShareIt) {
    Device& device = open_anew();
    Buffer copy;
    {
        const Buffer buffer = device.allocate("shared", 1000);
        copy = buffer;
    }
    EXPECT_GT(device.memory_by_name().at("shared").current, 0u);
    copy = Buffer();
    EXPECT_EQ(device.memory_by_name().at("shared").current, 0u);
}

TEST_F(Memory, CommandsKeepBuffersAlive) {
    Device& device = open_anew();
    const Buffer to = device.allocate("to", 40'000);
    {
        const Buffer from = upload(device, "from", std::vector<std::uint32_t>(10'000, 77));
        device.copy(from, to);
    }
    if (device.info().backend == "vulkan") { // the host runs them at once
        EXPECT_GT(device.memory_by_name().at("from").current, 0u);
    }
    EXPECT_EQ(download<std::uint32_t>(device, to, 10'000), std::vector<std::uint32_t>(10'000, 77));
    EXPECT_EQ(device.memory_by_name().at("from").current, 0u);
}

TEST_F(Memory, ScratchIsSharedAndGrows) {
    Device& device = open_anew();
    const Buffer small = device.scratch("scratch", 100);
    EXPECT_EQ(device.scratch("scratch", 60).storage(), small.storage());
    EXPECT_NE(device.scratch("another", 60).storage(), small.storage());
    EXPECT_GE(device.scratch("scratch", 5000).size(), 5000u);
    EXPECT_GE(device.scratch("scratch", 10).size(), 5000u);
}

TEST_F(Memory, ErrorsNameTheBufferThatIsTooLarge) {
    Device& range = open_anew({"", "", "storage_range=1MiB"});
    EXPECT_EQ(range.allocate("as much as goes", 1 << 20).size(), 1u << 20);
    EXPECT_THAT(error_of([&] { range.allocate("photon map", (1 << 20) + 1); }),
                AllOf(HasSubstr("'photon map'"), HasSubstr("1048577"), HasSubstr("1048576")));
    Device& memory = open_anew({"", "", "memory=4MiB"});
    const Buffer first = memory.allocate("first", 3 << 20);
    EXPECT_THAT(error_of([&] { memory.allocate("photon map", 2 << 20); }),
                AllOf(HasSubstr("'photon map'"), HasSubstr("memory")));
    EXPECT_EQ(memory.allocate("small", 1 << 19).size(), 1u << 19);
}

TEST_F(Memory, OfAFreedBufferServesTheNext) {
    Device& device = open_anew();
    const auto use = [&](std::uint32_t words) {
        // Through staging memory and as texels, where the backend has these.
        const Buffer from = upload(device, "from", std::vector<std::uint32_t>(words, words));
        const Buffer to = device.allocate("to", std::uint64_t(words) * 4);
        device.copy(from, to);
        EXPECT_EQ(download<std::uint32_t>(device, to, words),
                  std::vector<std::uint32_t>(words, words));
    };
    use(100'000);
    const BlockUse before = device.blocks();
    EXPECT_GE(before.free_bytes, 800'000u);
    EXPECT_GE(before.bytes, before.free_bytes);
    for (const std::uint32_t words : {100'000u, 99'999u, 90'000u, 100'000u}) {
        use(words);
    }
    EXPECT_EQ(device.blocks().allocations, before.allocations);
    EXPECT_EQ(device.blocks().bytes, before.bytes);
    EXPECT_EQ(device.memory_by_name().at("to").current, 0u);
    EXPECT_EQ(device.memory_by_name().at("to").peak, 400'000u);
    const Buffer kept = device.allocate("kept", 400'000);
    use(100'000);
    EXPECT_EQ(device.blocks().allocations, before.allocations + 1);
}

TEST_F(Memory, FreeBlocksAreReleasedWhereTheDeviceNeedsTheirMemory) {
    Device& device = open_anew({"", "", "memory=4MiB"});
    for (const std::uint64_t mebibytes : {1, 2, 3, 4, 1, 3}) {
        device.allocate("photon map", mebibytes << 20);
        EXPECT_LE(device.blocks().bytes, 4u << 20);
    }
    EXPECT_EQ(device.memory().peak, 4u << 20);
}

TEST_F(Memory, BuffersMayOutliveTheirDevice) {
    Buffer buffer;
    {
        const std::unique_ptr<Device> device = open_validated({});
        buffer = device->allocate("heir", 1000);
        device->fill(buffer, 1);
        device->wait();
    }
    EXPECT_EQ(buffer.size(), 1000u);
}

TEST_F(Memory, IsFilledWithUndefinedWordsIfPoisoned) {
    const ScopedEnvironment poison("ARGAND_POISON", "1");
    Device& device = open_anew();
    for (int i = 0; i < 2; ++i) {
        const Buffer buffer = device.allocate("poisoned", 400);
        EXPECT_EQ(download<std::uint32_t>(device, buffer, 100),
                  std::vector<std::uint32_t>(100, undefined_word));
        device.fill(buffer, 7);
    }
}

} // namespace
} // namespace argand
