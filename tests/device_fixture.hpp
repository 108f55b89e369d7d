#pragma once

#include "base/environment.hpp"
#include "device/device.hpp"
#include "device/validation.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace argand {

/// Sets an environment variable during its lifetime.
class ScopedEnvironment {
public:
    ScopedEnvironment(std::string name, const std::string& value)
        : name_(std::move(name)), before_(environment(name_.c_str())) {
        set(value);
    }
    ScopedEnvironment(const ScopedEnvironment&) = delete;
    ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;
    ~ScopedEnvironment() { set(before_); }

private:
    void set(const std::string& value) const {
#ifdef _WIN32
        _putenv_s(name_.c_str(), value.c_str());
#else
        setenv(name_.c_str(), value.c_str(), 1);
#endif
    }

    std::string name_;
    std::string before_;
};

/// A way to open the device under test.
struct DeviceSetting {
    std::string name;    ///< part of the test's name
    std::string disable; ///< ARGAND_DISABLE
    std::string limit;   ///< ARGAND_LIMIT
};

inline void PrintTo(const DeviceSetting& setting, std::ostream* out) { *out << setting.name; }

/// Settings that select the variants of kernels. A device that is not lane-serial takes the second
/// path twice. "least" is the minimum that Argand accepts.
inline std::vector<DeviceSetting> variant_settings() {
    return {{"default", "", ""},
            {"subgroups", "lane_serial", ""},
            {"shared", "lane_serial,subgroups", ""},
            {"least", "lane_serial,subgroups,push_descriptors,timestamps",
             fmt::format("invocations={},shared_memory={},storage_buffers={}",
                         Requirements::invocations, Requirements::shared_memory,
                         Requirements::storage_buffers)}};
}

/// Opens a device with the API's validation, unless ARGAND_VALIDATION=0.
inline std::unique_ptr<Device> open_validated(const DeviceSetting& setting) {
    const ScopedEnvironment validation("ARGAND_VALIDATION",
                                       environment("ARGAND_VALIDATION") == "0" ? "0" : "1");
    const ScopedEnvironment disable("ARGAND_DISABLE", setting.disable);
    const ScopedEnvironment limit("ARGAND_LIMIT", setting.limit);
    return open_device();
}

/// The devices that the tests of a process share, one for each setting. Opening a device and
/// compiling its kernels takes longer than most tests.
class SharedDevices : public ::testing::Environment {
public:
    Device& get(const DeviceSetting& setting) {
        std::unique_ptr<Device>& device = devices_[{setting.disable, setting.limit}];
        if (!device) {
            device = open_validated(setting);
        }
        return *device;
    }

    /// Closes them before the process ends, because drivers have static data of their own.
    void TearDown() override {
        devices_.clear();
        EXPECT_THAT(all_validation_messages(), ::testing::SizeIs(known_messages));
    }

    std::size_t known_messages = 0; ///< those that tests have checked

private:
    std::map<std::pair<std::string, std::string>, std::unique_ptr<Device>> devices_;
};

// GoogleTest deletes it.
inline SharedDevices& shared_devices = *static_cast<SharedDevices*>(
    ::testing::AddGlobalTestEnvironment(new SharedDevices)); // NOLINT(*-owning-memory)

/// Uses devices with the API's validation on; any validation message fails the test.
class DeviceTest : public ::testing::Test {
protected:
    /// The device of this setting, which all tests of the process share.
    Device& open(const DeviceSetting& setting = {}) { return use(shared_devices.get(setting)); }

    /// A device that is closed after the test.
    Device& open_anew(const DeviceSetting& setting = {}) {
        own_.push_back(open_validated(setting));
        return use(*own_.back());
    }

    /// Whether the device under test runs this kernel: some tests' kernels have no twin.
    static bool runs(const KernelInfo& kernel) {
        // Closed at once: an open device would share its validation messages with those of the
        // test.
        static const std::string backend = open_validated({})->info().backend;
        return backend == "vulkan" ||
               (backend == "cuda" ? kernel.cuda != nullptr : kernel.host != nullptr);
    }

    void TearDown() override {
        for (Device* device : used_) {
            device->wait();
        }
        own_.clear();
        const std::vector<std::string> messages = all_validation_messages();
        EXPECT_THAT(std::vector(messages.begin() +
                                    static_cast<std::ptrdiff_t>(shared_devices.known_messages),
                                messages.end()),
                    ::testing::IsEmpty());
        shared_devices.known_messages = messages.size();
    }

private:
    Device& use(Device& device) {
        used_.insert(&device);
        return device;
    }

    std::set<Device*> used_;
    std::vector<std::unique_ptr<Device>> own_;
};

/// A test that runs once for each of variant_settings(); see INSTANTIATE_VARIANTS.
class VariantTest : public DeviceTest, public ::testing::WithParamInterface<DeviceSetting> {
protected:
    Device& open_variant() { return open(GetParam()); }
};

#define INSTANTIATE_VARIANTS(suite)                                                                \
    INSTANTIATE_TEST_SUITE_P(Variants, suite, ::testing::ValuesIn(argand::variant_settings()),     \
                             [](const auto& variant) { return variant.param.name; })

} // namespace argand
