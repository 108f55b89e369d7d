#pragma once

#include "base/clock.hpp"
#include "device/device.hpp"
#include "device/device_memory.hpp"
#include "device/host/host_primitives.hpp"

#include <memory>

namespace argand::host {

/// Host memory, aligned to a cache line.
struct HostBlock final : MemoryBlock {
    std::byte* data = nullptr;

    ~HostBlock() override;
};

/// The 32-bit words of a range of a HostDevice's buffer.
std::span<std::uint32_t> words_of(const BufferView& view);

/// Describes the host's cores as a device.
DeviceInfo describe();

/// Runs the C++ twins of kernels on the host's cores. Executes every command immediately instead of
/// recording it.
class HostDevice : public Device {
public:
    explicit HostDevice(DeviceInfo info) : info_(std::move(info)) {}

    const DeviceInfo& info() const override { return info_; }
    Buffer allocate(std::string name, std::uint64_t bytes) override;
    void upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) override;
    void fill(const BufferView& to, std::uint32_t value) override;
    void copy(const BufferView& from, const BufferView& to) override;
    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override;
    void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                           const Buffer& counts, std::uint32_t count_index) override;
    Primitives* primitives() override { return &primitives_; }
    void submit() override {}
    void wait() override {}
    void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) override;
    void begin_stage(std::string_view name) override;
    void end_stage() override;
    std::vector<StageTime> stage_times() override { return times_; }
    void reset_stage_times() override { times_.clear(); }
    const std::map<std::string, MemoryUse>& memory_by_name() const override {
        return memory_->ledger().by_name;
    }
    MemoryUse memory() const override { return memory_->ledger().total; }
    BlockUse blocks() const override { return memory_->blocks(); }
    std::vector<std::string> validation_messages() const override { return {}; }

private:
    DeviceInfo info_;
    std::shared_ptr<DeviceMemory> memory_ = std::make_shared<DeviceMemory>();
    bool poisons_ = poisons_memory();
    HostPrimitives primitives_;
    std::vector<StageTime> times_;
    std::string stage_;
    Clock::time_point stage_start_;
};

} // namespace argand::host
