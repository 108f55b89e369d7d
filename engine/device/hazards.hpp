#pragma once

#include "device/buffer.hpp"
#include "device/kernel.hpp"

namespace argand {

/// Decides from declared reads and writes whether a command needs a barrier before it. Tracks whole
/// buffers: accesses to different ranges of a buffer conflict too.
class HazardTracker {
public:
    /// Whether accessing the buffer conflicts with commands recorded since the last barrier.
    bool conflicts(const BufferStorage& buffer, Access access) const {
        const bool writes = access != Access::read;
        return buffer.write_epoch == epoch_ || (writes && buffer.read_epoch == epoch_);
    }
    void record(BufferStorage& buffer, Access access) const {
        if (access != Access::write) {
            buffer.read_epoch = epoch_;
        }
        if (access != Access::read) {
            buffer.write_epoch = epoch_;
        }
    }
    void barrier() { ++epoch_; }

private:
    std::uint64_t epoch_ = 1;
};

} // namespace argand
