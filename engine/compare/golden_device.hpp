#pragma once

#include "compare/golden.hpp"
#include "device/host/host_device.hpp"

namespace argand {

/// Plays a capture back: instead of running a stage, it writes what the recorded device wrote.
/// Throws Error where what is asked for is not what was recorded next.
class GoldenDevice final : public host::HostDevice {
public:
    GoldenDevice(const Golden& golden, const GoldenCapture& capture);

    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override;
    Primitives* primitives() override { return primitives_.get(); }

    /// Throws Error if there are steps that were recorded and have not been played.
    void expect_end() const;

    /// The next step, which is to be this stage, on the buffers that it writes.
    void play(const std::string& stage, std::span<const BufferView> written);

private:
    const GoldenCapture& capture_;
    std::size_t next_ = 0;
    std::unique_ptr<Primitives> primitives_;
};

} // namespace argand
