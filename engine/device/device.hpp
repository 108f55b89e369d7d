#pragma once

#include "device/buffer.hpp"
#include "device/count.hpp"
#include "device/info.hpp"
#include "device/kernel.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace argand {

/// Contents of memory that was never written, in comparisons and with ARGAND_POISON=1.
inline constexpr std::uint32_t undefined_word = 0xcdcdcdcdu;

/// Device time of a stage, summed over its runs.
struct StageTime {
    std::string name;
    double seconds = 0; ///< between the stage's GPU time stamps; 0 if the device has none
    std::uint64_t runs = 0;
};

/// Bytes of all allocations with the same name.
struct MemoryUse {
    std::uint64_t current = 0;
    std::uint64_t peak = 0;
};

/// Memory that a device has reserved, in use or not.
struct BlockUse {
    std::uint64_t allocations = 0; ///< so far; buffers in the place of earlier ones do not count
    std::uint64_t bytes = 0;       ///< reserved now
    std::uint64_t free_bytes = 0;  ///< reserved now, but in no buffer
};

class Primitives;
class Raster;

/// A device that executes commands in the order in which they are recorded. All calls except
/// wait(), download() and stage_times() only record. Barriers follow from the reads and writes that
/// kernels declare. Not thread-safe.
class Device {
public:
    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    virtual ~Device() = default;

    virtual const DeviceInfo& info() const = 0;

    /// Allocates at least `bytes` bytes with undefined contents, if possible in the place of a
    /// buffer that is no longer in use. Throws Error if the device lacks the memory or kernels
    /// cannot address that many bytes.
    virtual Buffer allocate(std::string name, std::uint64_t bytes) = 0;
    /// Scratch memory: one buffer per name, shared by all callers with that name, and kept as long
    /// as the device. It is at least as large as the largest request. Any later user may overwrite
    /// it.
    Buffer scratch(const std::string& name, std::uint64_t bytes) {
        Buffer& buffer = scratch_[name];
        if (buffer.size() < bytes || !buffer) {
            buffer = Buffer(); // free the old one first, because it may be large
            buffer = allocate(name, bytes);
        }
        return buffer;
    }

    virtual void upload(const Buffer& to, std::uint64_t offset,
                        std::span<const std::byte> data) = 0;
    /// Fills with a 32-bit value. Offset and size are multiples of 4.
    virtual void fill(const BufferView& to, std::uint32_t value) = 0;
    virtual void copy(const BufferView& from, const BufferView& to) = 0;

    /// Runs the kernel on at least `threads` invocations. Kernels compare their index with the
    /// count.
    virtual void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                          std::uint64_t threads) = 0;
    /// Like dispatch(), but the device reads the thread count from the uint at `count_index` of
    /// `counts`.
    virtual void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                   const Buffer& counts, std::uint32_t count_index) = 0;

    /// The backend's own sort, scan, reduce and compact; null if kernels implement them.
    virtual Primitives* primitives() { return nullptr; }

    /// The device's rasteriser; null if it has none.
    virtual Raster* raster() { return nullptr; }

    /// Submits recorded commands without waiting for them.
    virtual void submit() = 0;
    /// Submits recorded commands and waits until they are complete.
    virtual void wait() = 0;
    /// Waits, then copies to the host.
    virtual void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) = 0;

    virtual void begin_stage(std::string_view name) = 0;
    virtual void end_stage() = 0;
    /// Waits, then returns the times since the device was opened or reset_stage_times() was called,
    /// in the order of first use.
    virtual std::vector<StageTime> stage_times() = 0;
    virtual void reset_stage_times() = 0;

    virtual const std::map<std::string, MemoryUse>& memory_by_name() const = 0;
    virtual MemoryUse memory() const = 0;
    virtual BlockUse blocks() const = 0;

    /// Messages of the API's validation so far. Validation is on in debug builds or with
    /// ARGAND_VALIDATION=1.
    virtual std::vector<std::string> validation_messages() const = 0;

private:
    std::map<std::string, Buffer> scratch_;
};

/// A stage that covers all commands recorded during its lifetime. Stages do not nest.
class StageScope {
public:
    StageScope(Device& device, std::string_view name) : device_(device) {
        device_.begin_stage(name);
    }
    StageScope(const StageScope&) = delete;
    StageScope& operator=(const StageScope&) = delete;
    /// Never throws: a failure of the device is already propagating, or the next call reports it.
    ~StageScope();

private:
    Device& device_;
};

template <class Kernel> void dispatch(Device& device, const Kernel& kernel, std::uint64_t threads) {
    device.dispatch(Kernel::info, kernel.arguments(), threads);
}

template <class Kernel>
void dispatch_indirect(Device& device, const Kernel& kernel, const Buffer& counts,
                       std::uint32_t count_index = 0) {
    device.dispatch_indirect(Kernel::info, kernel.arguments(), counts, count_index);
}

template <class Kernel> void dispatch(Device& device, const Kernel& kernel, const Count& count) {
    if (count.on_device()) {
        dispatch_indirect(device, kernel, count.buffer, count.index);
    } else {
        dispatch(device, kernel, count.bound);
    }
}

/// Memory that nobody else holds: `last`, or if it is in use elsewhere or too small, new memory,
/// which becomes `last`.
inline Buffer unshared(Device& device, Buffer& last, const char* name, std::uint64_t bytes) {
    if (last.size() < bytes || last.storage().use_count() > 1) {
        last = Buffer(); // freed first, for it may be large
        last = device.allocate(name, bytes);
    }
    return last;
}

/// Allocates a buffer for the elements and uploads them. The buffer has room for at least one
/// element so that it can be bound.
template <class T> // NOLINTNEXTLINE(performance-unnecessary-value-param): moved below
Buffer upload(Device& device, std::string name, std::span<const T> data) {
    Buffer buffer =
        device.allocate(std::move(name), std::max<std::size_t>(data.size_bytes(), sizeof(T)));
    if (!data.empty()) {
        device.upload(buffer, 0, std::as_bytes(data));
    }
    return buffer;
}
template <class T> Buffer upload(Device& device, std::string name, const std::vector<T>& data) {
    return upload(device, std::move(name), std::span<const T>(data));
}

template <class T>
std::vector<T> download(Device& device, const Buffer& from, std::size_t count,
                        std::size_t first = 0) {
    std::vector<T> data(count);
    if (count > 0) {
        device.download(from, first * sizeof(T), std::as_writable_bytes(std::span<T>(data)));
    }
    return data;
}

/// Uploads and downloads one uint of a buffer. index: in uints.
inline void upload_word(Device& device, const Buffer& to, std::size_t index, std::uint32_t word) {
    device.upload(to, index * sizeof(word), std::as_bytes(std::span(&word, 1)));
}
inline std::uint32_t download_word(Device& device, const Buffer& from, std::size_t index = 0) {
    return download<std::uint32_t>(device, from, 1, index)[0];
}

/// Whether a kernel should read these buffers of 16-byte records as texels. lavapipe reads four
/// words as texels in half the time that they take from a storage buffer.
inline bool read_as_texels(const Device& device, const Buffer& a, const Buffer& b) {
    return device.info().lane_serial() &&
           std::max(a.size(), b.size()) / 16 <= device.info().limits.texels;
}

/// Backends of this build, in order of preference.
const std::vector<std::string>& backend_names();

/// Why a backend of this build offers no device; empty if it offers one.
std::string why_missing(const std::string& backend);

/// Devices of all backends, suitable or not, in the order of their indices.
std::vector<DeviceInfo> list_devices();

/// Opens a device. `choice` is an index, part of a name (case-insensitive), or empty: then
/// ARGAND_DEVICE, then the best available device (discrete, integrated, virtual, CPU). `backend` is
/// one of backend_names(), or empty: then ARGAND_BACKEND, then the first that has a suitable
/// device. Throws Error if there is no such device or it is unsuitable, and UsageError if there is
/// no such backend.
std::unique_ptr<Device> open_device(const std::string& choice = "",
                                    const std::string& backend = "");

} // namespace argand
