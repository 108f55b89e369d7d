#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace argand {

/// A backend's side of a buffer; backends derive from it.
struct BufferStorage {
    std::string name;
    std::uint64_t size = 0; ///< bytes asked for
    std::uint64_t read_epoch =
        0; ///< barrier epoch of the last recorded read and write, see HazardTracker
    std::uint64_t write_epoch = 0;

    BufferStorage() = default;
    BufferStorage(const BufferStorage&) = delete;
    BufferStorage& operator=(const BufferStorage&) = delete;
    virtual ~BufferStorage() = default;
};

/// Memory on a device, known by a name. A handle: copies share the memory, the last one frees it,
/// and commands that are under way keep it alive.
class Buffer {
public:
    Buffer() = default;
    explicit Buffer(std::shared_ptr<BufferStorage> storage) : storage_(std::move(storage)) {}

    std::uint64_t size() const { return storage_ ? storage_->size : 0; }
    const std::string& name() const { return storage_->name; }
    const std::shared_ptr<BufferStorage>& storage() const { return storage_; }
    explicit operator bool() const { return storage_ != nullptr; }

private:
    std::shared_ptr<BufferStorage> storage_;
};

} // namespace argand
