#pragma once

#include "device/device.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace argand::testing {

/// Runs everything on another device and records what was dispatched and allocated.
class RecordingDevice final : public Device {
public:
    explicit RecordingDevice(Device& device) : device_(device) {}

    /// A kernel with the values of its specialization constants; each needs its own pipeline.
    using Variant = std::pair<const KernelInfo*, std::vector<std::uint32_t>>;

    const std::set<Variant>& variants() const { return variants_; }
    const std::set<std::string>& stages() const { return stages_; }
    /// Size of the largest buffer of this name; 0 if there was none.
    std::uint64_t bytes_of(const std::string& name) const {
        const auto found = bytes_.find(name);
        return found != bytes_.end() ? found->second : 0;
    }
    std::uint64_t runs_of(const std::string& kernel) const {
        const auto found = runs_.find(kernel);
        return found != runs_.end() ? found->second : 0;
    }

    /// Bytes uploaded so far.
    std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
    /// Bytes downloaded so far from buffers of this name.
    std::uint64_t downloaded_bytes(const std::string& name) const {
        const auto found = downloaded_bytes_.find(name);
        return found != downloaded_bytes_.end() ? found->second : 0;
    }

    /// Allocations so far by name.
    const std::map<std::string, std::uint64_t>& allocations() const { return allocations_; }

    const DeviceInfo& info() const override { return device_.info(); }
    Buffer allocate(std::string name, std::uint64_t bytes) override {
        std::uint64_t& largest = bytes_[name];
        largest = std::max(largest, bytes);
        ++allocations_[name];
        return device_.allocate(std::move(name), bytes);
    }
    void upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) override {
        uploaded_bytes_ += data.size();
        device_.upload(to, offset, data);
    }
    void fill(const BufferView& to, std::uint32_t value) override { device_.fill(to, value); }
    void copy(const BufferView& from, const BufferView& to) override { device_.copy(from, to); }
    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override {
        record(kernel, arguments);
        device_.dispatch(kernel, arguments, threads);
    }
    void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                           const Buffer& counts, std::uint32_t count_index) override {
        record(kernel, arguments);
        device_.dispatch_indirect(kernel, arguments, counts, count_index);
    }
    Primitives* primitives() override { return device_.primitives(); }
    void submit() override { device_.submit(); }
    void wait() override { device_.wait(); }
    void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) override {
        downloaded_bytes_[from.name()] += data.size();
        device_.download(from, offset, data);
    }
    void begin_stage(std::string_view name) override {
        stages_.emplace(name);
        device_.begin_stage(name);
    }
    void end_stage() override { device_.end_stage(); }
    std::vector<StageTime> stage_times() override { return device_.stage_times(); }
    void reset_stage_times() override { device_.reset_stage_times(); }
    const std::map<std::string, MemoryUse>& memory_by_name() const override {
        return device_.memory_by_name();
    }
    MemoryUse memory() const override { return device_.memory(); }
    BlockUse blocks() const override { return device_.blocks(); }
    std::vector<std::string> validation_messages() const override {
        return device_.validation_messages();
    }

private:
    void record(const KernelInfo& kernel, const KernelArguments& arguments) {
        variants_.insert({&kernel,
                          {arguments.constants.begin(),
                           arguments.constants.begin() + arguments.constant_count}});
        ++runs_[kernel.name];
    }

    Device& device_;
    std::set<Variant> variants_;
    std::set<std::string> stages_;
    std::uint64_t uploaded_bytes_ = 0;
    std::map<std::string, std::uint64_t> downloaded_bytes_;
    std::map<std::string, std::uint64_t> bytes_, runs_, allocations_;
};

} // namespace argand::testing
