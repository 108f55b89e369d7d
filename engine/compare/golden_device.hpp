#pragma once

#include "compare/golden.hpp"
#include "device/host/host_device.hpp"

namespace argand {

/// Plays a capture back: instead of running a stage, writes the results that were recorded for it.
/// Throws Error if a stage is requested that is not the next one in the capture.
class GoldenDevice final : public host::HostDevice {
public:
    GoldenDevice(const Golden& golden, const GoldenCapture& capture);

    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override;
    Primitives* primitives() override { return primitives_.get(); }

    /// Throws Error if recorded steps remain.
    void expect_end() const;

    /// Plays the next step, which must be this stage, into the buffers that it writes.
    void play(const std::string& stage, std::span<const BufferView> written);

private:
    const GoldenCapture& capture_;
    std::size_t next_ = 0;
    std::unique_ptr<Primitives> primitives_;
};

} // namespace argand
