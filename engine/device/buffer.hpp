#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace argand {

/// The backend's part of a buffer; backends derive from it.
struct BufferStorage {
    std::string name;
    std::uint64_t size = 0; ///< requested bytes
    /// Barrier epochs of the last recorded read and write, see HazardTracker.
    std::uint64_t read_epoch = 0;
    std::uint64_t write_epoch = 0;

    BufferStorage() = default;
    BufferStorage(const BufferStorage&) = delete;
    BufferStorage& operator=(const BufferStorage&) = delete;
    virtual ~BufferStorage() = default;
};

/// Named memory on a device. A Buffer is a handle: copies share the memory, the last one frees it,
/// and pending commands keep it alive.
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
