#include "device/cuda/cuda_device.hpp"

#include "base/error.hpp"
#include "device/twin.hpp"

#include <algorithm>
#include <fstream>

namespace argand::cuda {

namespace {

// Stage runs whose events are kept before collect() adds them up.
constexpr std::size_t most_runs = 512;
// Threads to launch if only the device knows the count; kernels loop over the rest with this
// stride.
constexpr std::uint64_t indirect_threads = 1u << 20;

std::byte* pointer_of(const Buffer& buffer, std::uint64_t offset) {
    return static_cast<std::byte*>(block_of<CudaBlock>(buffer).pointer) + offset;
}

/// The kernel driver's version followed by a space; empty if unknown.
std::string driver_version() {
    std::ifstream file("/proc/driver/nvidia/version");
    for (std::string word; file >> word;) {
        if (!word.empty() && word.find_first_not_of("0123456789.") == std::string::npos) {
            return word + " ";
        }
    }
    return "";
}

std::uint64_t size_of(const BufferView& view) {
    return view.size > 0 ? view.size : view.buffer->size() - view.offset;
}

} // namespace

void check(cudaError_t result, const std::string& doing, const std::string& device) {
    if (result != cudaSuccess) {
        throw DeviceFault(
            "cuda",
            fmt::format("{} on '{}': CUDA says '{}'; try --backend vulkan, or update the driver",
                        doing, device, cudaGetErrorString(result)));
    }
}

CudaBlock::~CudaBlock() {
    // cudaFree waits for pending work. It fails after a kernel has failed; that failure was
    // reported before.
    cudaSetDevice(device);
    cudaFree(pointer);
}

CudaDevice::CudaDevice(DeviceInfo info, int ordinal) : info_(std::move(info)), ordinal_(ordinal) {
    check(cudaSetDevice(ordinal_), "opening a device", info_.name);
    check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "creating a stream",
          info_.name);
    primitives_ = make_primitives(*this, stream_);
}

CudaDevice::~CudaDevice() {
    cudaStreamSynchronize(stream_);
    for (const StageRun& run : runs_) {
        idle_events_.insert(idle_events_.end(), {run.begin, run.end});
    }
    for (const cudaEvent_t event : idle_events_) {
        if (event != nullptr) {
            cudaEventDestroy(event);
        }
    }
    cudaStreamDestroy(stream_);
}

void CudaDevice::make_current() const {
    check(cudaSetDevice(ordinal_), "selecting a device", info_.name);
}

Buffer CudaDevice::allocate(std::string name, std::uint64_t bytes) {
    make_current();
    check_allocation(info_, memory_->ledger(), name, bytes);
    const auto allocate = [&](std::uint64_t size) -> std::unique_ptr<MemoryBlock> {
        auto block = std::make_unique<CudaBlock>();
        block->bytes = size;
        block->device = ordinal_;
        const cudaError_t result = cudaMalloc(&block->pointer, size);
        if (result == cudaErrorMemoryAllocation) {
            cudaGetLastError(); // clear the error so that the next call does not report it
            return nullptr;
        }
        check(result, fmt::format("allocating '{}'", name), info_.name);
        return block;
    };
    // Commands that still use a free block come first in the stream.
    Buffer buffer(memory_->allocate(info_, name, bytes, allocate));
    if (poisons_) {
        fill(buffer, undefined_word);
    }
    return buffer;
}

void CudaDevice::upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) {
    make_current();
    check(cudaMemcpyAsync(pointer_of(to, offset), data.data(), data.size(), cudaMemcpyHostToDevice,
                          stream_),
          "uploading", info_.name);
    wait(); // the caller may change the data after return
}

void CudaDevice::fill(const BufferView& to, std::uint32_t value) {
    make_current();
    fill_words(pointer_of(*to.buffer, to.offset), size_of(to) / sizeof(std::uint32_t), value,
               stream_);
    check(cudaGetLastError(), "filling a buffer", info_.name);
}

void CudaDevice::copy(const BufferView& from, const BufferView& to) {
    make_current();
    check(cudaMemcpyAsync(pointer_of(*to.buffer, to.offset), pointer_of(*from.buffer, from.offset),
                          std::min(size_of(from), size_of(to)), cudaMemcpyDeviceToDevice, stream_),
          "copying", info_.name);
}

void CudaDevice::launch(const KernelInfo& kernel, const KernelArguments& arguments,
                        std::uint64_t threads, const std::uint32_t* count) {
    LaunchOnCuda* const run =
        twin_for(kernel, arguments.constants, &KernelInfo::cuda, &LeanModule::cuda);
    if (run == nullptr) {
        fail("running kernel {}: it has no twin for backend cuda; please report this", kernel.name);
    }
    if (threads == 0) {
        return;
    }
    check_threads(kernel, threads);
    make_current();
    TwinArguments twin;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        twin.buffers[i] = pointer_of(*arguments.buffers[i], arguments.offsets[i]);
    }
    std::copy(arguments.push.begin(), arguments.push.end(), twin.push);
    std::copy(arguments.constants.begin(), arguments.constants.end(), twin.constants);
    run(twin, threads, count, stream_);
    check(cudaGetLastError(), fmt::format("running kernel {}", kernel.name), info_.name);
}

void CudaDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                          std::uint64_t threads) {
    launch(kernel, arguments, threads, nullptr);
}

void CudaDevice::dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                   const Buffer& counts, std::uint32_t count_index) {
    const auto* count = reinterpret_cast<const std::uint32_t*>(pointer_of(counts, 0)) + count_index;
    launch(kernel, arguments, indirect_threads, count);
}

void CudaDevice::wait() { check(cudaStreamSynchronize(stream_), "running kernels", info_.name); }

void CudaDevice::download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    make_current();
    check(cudaMemcpyAsync(data.data(), pointer_of(from, offset), data.size(),
                          cudaMemcpyDeviceToHost, stream_),
          "downloading", info_.name);
    wait();
}

cudaEvent_t CudaDevice::stamp() {
    make_current();
    cudaEvent_t event = nullptr;
    if (idle_events_.empty()) {
        check(cudaEventCreate(&event), "creating an event", info_.name);
    } else {
        event = idle_events_.back();
        idle_events_.pop_back();
    }
    check(cudaEventRecord(event, stream_), "recording an event", info_.name);
    return event;
}

void CudaDevice::begin_stage(std::string_view name) {
    auto found = std::find_if(times_.begin(), times_.end(),
                              [&](const StageTime& time) { return time.name == name; });
    if (found == times_.end()) {
        found = times_.insert(times_.end(), {std::string(name), 0, 0});
    }
    if (runs_.size() >= most_runs) {
        collect();
    }
    if (info_.features.timestamps) {
        runs_.push_back({static_cast<std::size_t>(found - times_.begin()), stamp(), nullptr});
    }
    ++found->runs;
}

void CudaDevice::end_stage() {
    if (info_.features.timestamps) {
        runs_.back().end = stamp();
    }
}

void CudaDevice::collect() {
    wait();
    for (const StageRun& run : runs_) {
        if (run.end != nullptr) {
            float milliseconds = 0;
            check(cudaEventElapsedTime(&milliseconds, run.begin, run.end), "timing a stage",
                  info_.name);
            times_[run.stage].seconds += milliseconds * 1e-3;
            idle_events_.push_back(run.end);
        }
        idle_events_.push_back(run.begin);
    }
    runs_.clear();
}

std::vector<StageTime> CudaDevice::stage_times() {
    collect();
    return times_;
}

void CudaDevice::reset_stage_times() {
    collect();
    times_.clear();
}

std::vector<DeviceInfo> list_devices(std::string& missing) {
    int count = 0;
    const cudaError_t result = cudaGetDeviceCount(&count);
    if (result != cudaSuccess) {
        cudaGetLastError();
        missing = result == cudaErrorInsufficientDriver
                      ? "there is no NVIDIA driver, or it is older than CUDA " +
                            std::to_string(CUDART_VERSION / 1000)
                      : fmt::format("CUDA says '{}'", cudaGetErrorString(result));
        return {};
    }
    int driver = 0;
    cudaDriverGetVersion(&driver);
    std::vector<DeviceInfo> devices;
    for (int i = 0; i < count; ++i) {
        cudaDeviceProp properties{};
        DeviceInfo info;
        info.backend = "cuda";
        if (const cudaError_t described = cudaGetDeviceProperties(&properties, i);
            described != cudaSuccess) {
            cudaGetLastError();
            info.name = fmt::format("CUDA device {}", i);
            info.unsuitable = fmt::format("CUDA says '{}'", cudaGetErrorString(described));
            devices.push_back(std::move(info));
            continue;
        }
        info.name = properties.name;
        info.driver = fmt::format("NVIDIA {}for CUDA {}.{}", driver_version(), driver / 1000,
                                  driver % 1000 / 10);
        info.api_version = fmt::format("{}.{}", CUDART_VERSION / 1000, CUDART_VERSION % 1000 / 10);
        info.kind = properties.integrated != 0 ? DeviceKind::integrated : DeviceKind::discrete;
        info.subgroup_size = static_cast<std::uint32_t>(properties.warpSize);
        info.features.timestamps = true;
        info.limits.memory = properties.totalGlobalMem;
        info.limits.storage_range =
            std::min<std::uint64_t>(properties.totalGlobalMem, most_addressable);
        info.limits.invocations = static_cast<std::uint32_t>(properties.maxThreadsPerBlock);
        info.limits.shared_memory = static_cast<std::uint32_t>(properties.sharedMemPerBlock);
        info.limits.storage_buffers = max_bindings;
        info.limits.groups = static_cast<std::uint32_t>(properties.maxGridSize[0]);
        constexpr int least_major = 7;
        constexpr int least_minor = 5;
        if (std::pair(properties.major, properties.minor) < std::pair(least_major, least_minor)) {
            info.unsuitable =
                fmt::format("its compute capability is {}.{}, Argand needs {}.{}", properties.major,
                            properties.minor, least_major, least_minor);
        }
        devices.push_back(std::move(info));
    }
    if (devices.empty()) {
        missing = "CUDA offers no device";
    }
    return devices;
}

std::unique_ptr<Device> open(DeviceInfo info, int ordinal) {
    return std::make_unique<CudaDevice>(std::move(info), ordinal);
}

} // namespace argand::cuda
