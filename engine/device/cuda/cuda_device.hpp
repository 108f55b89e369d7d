#pragma once

#include "device/device.hpp"
#include "device/device_memory.hpp"
#include "device/primitives.hpp"

#include <cuda_runtime_api.h>
#include <memory>

namespace argand::cuda {

/// Throws DeviceFault with the activity and the device's name, unless the result is success.
void check(cudaError_t result, const std::string& doing, const std::string& device);

/// Memory of a CUDA device. Its destructor makes that device current.
struct CudaBlock final : MemoryBlock {
    void* pointer = nullptr;
    int device = 0;

    ~CudaBlock() override;
};

/// CUDA's devices, in CUDA's order; empty if there is no driver, with the reason in `missing`.
/// Never throws.
std::vector<DeviceInfo> list_devices(std::string& missing);

/// Runs the CUDA twins of kernels on an NVIDIA GPU, in the order of one stream.
class CudaDevice final : public Device {
public:
    /// `ordinal`: CUDA's index of the device.
    CudaDevice(DeviceInfo info, int ordinal);
    ~CudaDevice() override;

    const DeviceInfo& info() const override { return info_; }
    Buffer allocate(std::string name, std::uint64_t bytes) override;
    void upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) override;
    void fill(const BufferView& to, std::uint32_t value) override;
    void copy(const BufferView& from, const BufferView& to) override;
    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override;
    void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                           const Buffer& counts, std::uint32_t count_index) override;
    Primitives* primitives() override { return primitives_.get(); }
    void submit() override {}
    void wait() override;
    void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) override;
    void begin_stage(std::string_view name) override;
    void end_stage() override;
    std::vector<StageTime> stage_times() override;
    void reset_stage_times() override;
    const std::map<std::string, MemoryUse>& memory_by_name() const override {
        return memory_->ledger().by_name;
    }
    MemoryUse memory() const override { return memory_->ledger().total; }
    BlockUse blocks() const override { return memory_->blocks(); }
    std::vector<std::string> validation_messages() const override { return {}; }

private:
    /// Events around one run of a stage.
    struct StageRun {
        std::size_t stage;
        cudaEvent_t begin, end; ///< end: null if an error prevented it
    };

    void make_current() const;
    cudaEvent_t stamp();
    void collect();
    void launch(const KernelInfo& kernel, const KernelArguments& arguments, std::uint64_t threads,
                const std::uint32_t* count);

    DeviceInfo info_;
    int ordinal_;
    cudaStream_t stream_ = nullptr;
    std::shared_ptr<DeviceMemory> memory_ = std::make_shared<DeviceMemory>();
    bool poisons_ = poisons_memory();
    std::unique_ptr<Primitives> primitives_;
    std::vector<StageTime> times_;
    std::vector<StageRun> runs_;
    std::vector<cudaEvent_t> idle_events_;
};

/// Opens the device with this index in list_devices().
std::unique_ptr<Device> open(DeviceInfo info, int ordinal);

/// Fills memory with a word on a stream. cudaGetLastError reports errors.
void fill_words(void* to, std::uint64_t count, std::uint32_t value, cudaStream_t stream);

/// CUB's sort, scan, reduce and compact on a device's stream.
std::unique_ptr<Primitives> make_primitives(Device& device, cudaStream_t stream);

} // namespace argand::cuda
