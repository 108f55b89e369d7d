#include "base/error.hpp"
#include "device_fixture.hpp"
#include "support/expect_error.hpp"

#include <cctype>

namespace argand {
namespace {

using argand::testing::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Open : public DeviceTest {};

TEST_F(Open, ListsDevicesByIndex) {
    const std::vector<DeviceInfo> devices = list_devices();
    ASSERT_FALSE(devices.empty());
    for (std::size_t i = 0; i < devices.size(); ++i) {
        EXPECT_EQ(devices[i].index, i);
        EXPECT_FALSE(devices[i].name.empty());
        EXPECT_THAT(backend_names(), ::testing::Contains(devices[i].backend));
    }
}

TEST_F(Open, TheHostIsTheLastDevice) {
    EXPECT_EQ(list_devices().back().backend, "cpu");
    EXPECT_EQ(open_device("", "cpu")->info().backend, "cpu");
    EXPECT_EQ(open_device("", "vulkan")->info().backend, "vulkan");
    const ScopedEnvironment backend("ARGAND_BACKEND", "cpu");
    EXPECT_EQ(open_device()->info().backend, "cpu");
    EXPECT_THAT(error_of([] { open_device("", "metal"); }),
                AllOf(HasSubstr("'metal'"), HasSubstr("vulkan")));
}

TEST_F(Open, ByIndexPartOfTheNameOrEnvironment) {
    const DeviceInfo info = open_anew().info();
    EXPECT_EQ(open_device(std::to_string(info.index))->info().index, info.index);
    std::string part = info.name.substr(1, 6);
    std::transform(part.begin(), part.end(), part.begin(),
                   [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(open_device(part)->info().name, info.name);
    const ScopedEnvironment device("ARGAND_DEVICE", part);
    EXPECT_EQ(open_device()->info().name, info.name);
}

TEST_F(Open, UnknownDevicesAreErrors) {
    EXPECT_THAT(error_of([] { open_device("no such device"); }),
                AllOf(HasSubstr("'no such device'"), HasSubstr("argand devices")));
    EXPECT_THAT(error_of([] { open_device("1000"); }),
                AllOf(HasSubstr("1000"), HasSubstr("argand devices")));
    const ScopedEnvironment device("ARGAND_DEVICE", "1000");
    EXPECT_THAT(error_of([] { open_device(); }), HasSubstr("1000"));
}

TEST_F(Open, DisabledFeaturesAreOff) {
    const Features all = open_anew().info().features;
    EXPECT_FALSE(open_anew({"", "subgroups", ""}).info().features.subgroups);
    EXPECT_FALSE(open_anew({"", "push_descriptors", ""}).info().features.push_descriptors);
    EXPECT_FALSE(open_anew({"", "timestamps", ""}).info().features.timestamps);
    const DeviceInfo info = open_anew({"", ",lane_serial,,subgroups,", ""}).info();
    EXPECT_FALSE(info.lane_serial());
    EXPECT_FALSE(info.features.subgroups);
    EXPECT_EQ(info.features.push_descriptors, all.push_descriptors);
    EXPECT_EQ(info.features.timestamps, all.timestamps);
}

TEST_F(Open, LimitsAreLoweredNeverRaised) {
    const Limits device = open_anew().info().limits;
    const Limits lowered =
        open_anew({"", "", "storage_range=2MiB,invocations=128,memory=1GiB,groups=7"})
            .info()
            .limits;
    EXPECT_EQ(lowered.storage_range, 2u << 20);
    EXPECT_EQ(lowered.invocations, 128u);
    EXPECT_EQ(lowered.memory, std::min<std::uint64_t>(device.memory, 1u << 30));
    EXPECT_EQ(lowered.groups, 7u);
    EXPECT_EQ(lowered.shared_memory, device.shared_memory);
    EXPECT_EQ(open_anew({"", "", "invocations=4000000000"}).info().limits.invocations,
              device.invocations);
}

TEST_F(Open, UnknownFeaturesAndLimitsAreUsageErrors) {
    const auto opening = [&](const char* disable, const char* limit) {
        return [this, disable, limit] { open_anew({"", disable, limit}); };
    };
    EXPECT_THROW(opening("subgroup", "")(), UsageError);
    EXPECT_THROW(opening("", "storage=1")(), UsageError);
    EXPECT_THAT(
        error_of(opening("subgroup", "")),
        AllOf(HasSubstr("ARGAND_DISABLE"), HasSubstr("'subgroup'"), HasSubstr("push_descriptors")));
    EXPECT_THAT(
        error_of(opening("", "storage=1")),
        AllOf(HasSubstr("ARGAND_LIMIT"), HasSubstr("'storage=1'"), HasSubstr("storage_range")));
    for (const char* bad : {"groups", "groups=", "groups=x", "groups=1TiB", "groups=-1",
                            "groups=99999999999999999999"}) {
        EXPECT_THROW(opening("", bad)(), UsageError) << bad;
    }
}

TEST_F(Open, ADeviceBelowTheRequirementsIsAnError) {
    for (const char* limit :
         {"invocations=64", "shared_memory=8KiB", "storage_buffers=4", "storage_range=64KiB"}) {
        SCOPED_TRACE(limit);
        EXPECT_THAT(
            error_of([&] {
                open_anew({"", "", limit});
            }),
            AllOf(HasSubstr("opening device"), HasSubstr("needs"), HasSubstr("argand devices")));
    }
}

TEST_F(Open, ValidationMessagesAreReported) {
    const ScopedEnvironment validation("ARGAND_VALIDATION", "1");
    std::unique_ptr<Device> device;
    try {
        device = open_device();
    } catch (const Error& error) {
        ASSERT_THAT(error.what(), HasSubstr("install vulkan-validationlayers"));
        GTEST_SKIP() << "the validation layers are missing";
    }
    if (device->info().backend != "vulkan") {
        GTEST_SKIP() << "only Vulkan has validation layers";
    }
    const Buffer buffer = device->allocate("small", 64);
    EXPECT_TRUE(device->validation_messages().empty());
    device->fill(BufferView(buffer, 0, 1 << 20), 0);
    EXPECT_FALSE(device->validation_messages().empty());
    shared_devices.known_messages = all_validation_messages().size(); // no failure of this test
    // Destroying the device drops recorded commands without running them.
}

} // namespace
} // namespace argand
