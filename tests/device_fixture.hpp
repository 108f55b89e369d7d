#pragma once

#include "base/environment.hpp"
#include "device/device.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <ostream>
#include <string>
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

/// Opens devices with the API's validation; any validation message fails the test.
class DeviceTest : public testing::Test {
protected:
    Device& open(const DeviceSetting& setting = {}) {
        const ScopedEnvironment validation("ARGAND_VALIDATION", "1");
        const ScopedEnvironment disable("ARGAND_DISABLE", setting.disable);
        const ScopedEnvironment limit("ARGAND_LIMIT", setting.limit);
        devices_.push_back(open_device());
        return *devices_.back();
    }

    void TearDown() override {
        for (const std::unique_ptr<Device>& device : devices_) {
            device->wait();
            EXPECT_THAT(device->validation_messages(), testing::IsEmpty());
        }
        devices_.clear();
    }

private:
    std::vector<std::unique_ptr<Device>> devices_;
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
