#pragma once

#include "device/buffer.hpp"
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

/// Time that the device spent in a stage, summed over all its runs.
struct StageTime {
    std::string name;
    double seconds = 0; ///< between the stage's GPU time stamps; 0 if the device has none
    std::uint64_t runs = 0;
};

/// Bytes of all allocations of one name.
struct MemoryUse {
    std::uint64_t current = 0;
    std::uint64_t peak = 0;
};

class Primitives;

/// A device that runs kernels in the order in which they are recorded. All calls but wait(),
/// download() and stage_times() only record; barriers follow from the kernels' declared reads and
/// writes. One thread at a time.
class Device {
public:
    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    virtual ~Device() = default;

    virtual const DeviceInfo& info() const = 0;

    /// Allocates at least `bytes` bytes, contents undefined. Throws Error if the device has not got
    /// them, or if they exceed the range that a kernel can address.
    virtual Buffer allocate(std::string name, std::uint64_t bytes) = 0;
    /// Working memory: one buffer per name, shared by all who ask for it, at least as large as the
    /// largest asked for, and kept as long as the device. Whoever asks next overwrites it.
    Buffer scratch(const std::string& name, std::uint64_t bytes) {
        Buffer& buffer = scratch_[name];
        if (buffer.size() < bytes || !buffer) {
            buffer = Buffer(); // freed first, for it may be large
            buffer = allocate(name, bytes);
        }
        return buffer;
    }

    virtual void upload(const Buffer& to, std::uint64_t offset,
                        std::span<const std::byte> data) = 0;
    /// Repeats a 32-bit value; offset and size are multiples of 4.
    virtual void fill(const BufferView& to, std::uint32_t value) = 0;
    virtual void copy(const BufferView& from, const BufferView& to) = 0;

    /// Runs the kernel on at least `threads` invocations; kernels test their index against the
    /// count.
    virtual void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                          std::uint64_t threads) = 0;
    /// As dispatch, with the count of threads read on the device from the uint at `count_index` of
    /// `counts`.
    virtual void dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                   const Buffer& counts, std::uint32_t count_index) = 0;

    /// The backend's own sort, scan, reduce and compact; null: they are made of kernels.
    virtual Primitives* primitives() { return nullptr; }

    /// Hands what is recorded to the device without waiting for it.
    virtual void submit() = 0;
    /// Submits and waits until everything is done.
    virtual void wait() = 0;
    /// Waits, then copies to the host.
    virtual void download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) = 0;

    virtual void begin_stage(std::string_view name) = 0;
    virtual void end_stage() = 0;
    /// Waits, then returns the times since the device was opened or reset_stage_times() called, in
    /// the order of first use.
    virtual std::vector<StageTime> stage_times() = 0;
    virtual void reset_stage_times() = 0;

    virtual const std::map<std::string, MemoryUse>& memory_by_name() const = 0;
    virtual MemoryUse memory() const = 0;

    /// Messages of the API's validation so far (only if it is on: debug builds, or
    /// ARGAND_VALIDATION=1).
    virtual std::vector<std::string> validation_messages() const = 0;

private:
    std::map<std::string, Buffer> scratch_;
};

/// Names what is recorded during its life as a stage. Stages do not nest.
class StageScope {
public:
    StageScope(Device& device, std::string_view name) : device_(device) {
        device_.begin_stage(name);
    }
    StageScope(const StageScope&) = delete;
    StageScope& operator=(const StageScope&) = delete;
    /// Throws nothing: that the device has failed is on its way up already, or is said to whoever
    /// calls next.
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

/// Allocates a buffer for the elements and uploads them; at least one element is allocated, so that
/// it can be bound.
template <class T> Buffer upload(Device& device, std::string name, std::span<const T> data) {
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

/// Whether a kernel should read these buffers of 16-byte records as texels: lavapipe reads four
/// words as texels in half the time that it takes to read them from a storage buffer.
inline bool read_as_texels(const Device& device, const Buffer& a, const Buffer& b) {
    return device.info().lane_serial() &&
           std::max(a.size(), b.size()) / 16 <= device.info().limits.texels;
}

/// Backends that this build has, in the order in which they are preferred.
const std::vector<std::string>& backend_names();

/// Why a backend of this build offers no device; empty if it has one.
std::string why_missing(const std::string& backend);

/// Devices of all backends, suitable or not, in the order of their indices.
std::vector<DeviceInfo> list_devices();

/// Opens a device. `choice` is an index, part of a name (case does not matter), or empty: then
/// ARGAND_DEVICE, then the best there is (discrete, integrated, virtual, CPU). `backend` is one of
/// backend_names(), or empty: then ARGAND_BACKEND, then the first that has a suitable device.
/// Throws Error if there is none or it is unsuitable, and UsageError if there is no such backend.
std::unique_ptr<Device> open_device(const std::string& choice = "",
                                    const std::string& backend = "");

} // namespace argand
