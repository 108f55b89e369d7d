#include "device_fixture.hpp"

#include <numeric>

namespace argand {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Words = std::vector<std::uint32_t>;

class Transfer : public DeviceTest {};

Bytes counted_bytes(std::size_t n, std::uint8_t first) {
    Bytes bytes(n);
    std::iota(bytes.begin(), bytes.end(), first);
    return bytes;
}

// Up to 65,536 bytes travel inside a command buffer; larger uploads use a staging buffer.
TEST_F(Transfer, RoundTripsAllSizes) {
    Device& device = open_anew();
    for (const std::size_t n : {0, 1, 2, 3, 4, 5, 7, 15, 16, 17, 1023, 65535, 65536, 65537, 65540,
                                1 << 20, (1 << 24) + 1}) {
        SCOPED_TRACE(n);
        const Bytes bytes = counted_bytes(n, 3);
        const Buffer buffer = upload(device, "bytes", bytes);
        EXPECT_TRUE(download<std::uint8_t>(device, buffer, n) == bytes);
    }
}

TEST_F(Transfer, RoundTripsPartsOfABuffer) {
    Device& device = open_anew();
    for (const std::size_t n : {40, 200'000}) {
        Bytes expected = counted_bytes(n, 0);
        const Buffer buffer = upload(device, "bytes", expected);
        for (const auto& [offset, size] : {std::pair<std::size_t, std::size_t>{0, 1},
                                           {3, 6},
                                           {4, 8},
                                           {n - 1, 1},
                                           {n / 2, n / 3}}) {
            SCOPED_TRACE(testing::Message() << size << " bytes at " << offset << " of " << n);
            const Bytes part = counted_bytes(size, static_cast<std::uint8_t>(100 + size));
            device.upload(buffer, offset, std::as_bytes(std::span(part)));
            std::copy(part.begin(), part.end(),
                      expected.begin() + static_cast<std::ptrdiff_t>(offset));
            EXPECT_TRUE(download<std::uint8_t>(device, buffer, size, offset) == part);
            EXPECT_TRUE(download<std::uint8_t>(device, buffer, n) == expected);
        }
    }
}

TEST_F(Transfer, LaterUploadsWin) {
    Device& device = open_anew();
    const Buffer buffer = upload(device, "words", Words(100, 1));
    const Words twos(60, 2);
    const Words threes(60, 3);
    device.upload(buffer, 0, std::as_bytes(std::span(twos)));
    device.upload(buffer, 160, std::as_bytes(std::span(threes)));
    Words expected(40, 2);
    expected.resize(100, 3);
    EXPECT_EQ(download<std::uint32_t>(device, buffer, 100), expected);
}

TEST_F(Transfer, Fill) {
    Device& device = open_anew();
    const Buffer buffer = upload(device, "words", Words(1000, 1));
    device.fill(BufferView(buffer, 8, 4), 7);
    device.fill(BufferView(buffer, 3960, 0), 9); // to the end
    Words expected(1000, 1);
    expected[2] = 7;
    std::fill(expected.begin() + 990, expected.end(), 9u);
    EXPECT_EQ(download<std::uint32_t>(device, buffer, 1000), expected);
    device.fill(buffer, 0xffffffff);
    EXPECT_EQ(download<std::uint32_t>(device, buffer, 1000), Words(1000, 0xffffffff));
    const Buffer nothing = device.allocate("nothing", 0);
    device.fill(nothing, 1);
}

TEST_F(Transfer, Copy) {
    Device& device = open_anew();
    const Bytes bytes = counted_bytes(300'001, 0);
    const Buffer from = upload(device, "from", bytes);
    const Buffer to = device.allocate("to", bytes.size());
    device.copy(from, to);
    EXPECT_TRUE(download<std::uint8_t>(device, to, bytes.size()) == bytes);

    // Copies the shorter of both ranges.
    device.copy(BufferView(from, 5, 3), BufferView(to, 100, 0));
    device.copy(BufferView(from, 7, 0), BufferView(to, 300'000, 1));
    Bytes expected = bytes;
    std::copy(bytes.begin() + 5, bytes.begin() + 8, expected.begin() + 100);
    expected[300'000] = bytes[7];
    EXPECT_TRUE(download<std::uint8_t>(device, to, bytes.size()) == expected);

    device.copy(device.allocate("nothing", 0), to);
    EXPECT_TRUE(download<std::uint8_t>(device, to, bytes.size()) == expected);
}

TEST_F(Transfer, BuffersOutliveTheirDevice) {
    Buffer buffer;
    {
        const ScopedEnvironment validation("ARGAND_VALIDATION", "1");
        const std::unique_ptr<Device> device = open_device();
        buffer = upload(*device, "words", Words(5, 1));
        EXPECT_EQ(device->validation_messages(), std::vector<std::string>());
    }
    EXPECT_EQ(buffer.size(), 20u);
    EXPECT_EQ(buffer.name(), "words");
}

} // namespace
} // namespace argand
