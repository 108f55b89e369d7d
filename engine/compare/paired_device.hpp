#pragma once

#include "compare/comparison.hpp"
#include "compare/golden.hpp"
#include "compare/stage.hpp"
#include "device/device.hpp"
#include "device/primitives.hpp"

#include <functional>
#include <memory>

namespace argand {

enum class Pairing {
    isolated,  ///< every stage of the second device starts from the first one's input
    end_to_end ///< the second device continues with its own results
};

/// A buffer on either device.
struct PairedBuffer final : BufferStorage {
    Buffer a, b;
};

/// Two devices as one: runs commands on both, stage by stage, and compares their results. Downloads
/// return the first device's data.
class PairedDevice final : public Device {
public:
    PairedDevice(Device& a, Device& b, Pairing pairing);
    ~PairedDevice() override;

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
    void begin_stage(std::string_view) override {}
    void end_stage() override {}
    std::vector<StageTime> stage_times() override { return {}; }
    void reset_stage_times() override {}
    const std::map<std::string, MemoryUse>& memory_by_name() const override {
        return a_.memory_by_name();
    }
    MemoryUse memory() const override { return a_.memory(); }
    BlockUse blocks() const override { return a_.blocks(); }
    std::vector<std::string> validation_messages() const override {
        return a_.validation_messages();
    }

    /// In the order of the stages' first runs.
    const std::vector<StageComparison>& comparisons() const { return comparisons_; }

    /// Runs a stage on both devices and compares the results. If isolated, then copies the first
    /// device's results to the second.
    void run(const std::string& stage, const std::function<void()>& on_a,
             const std::function<void()>& on_b, const std::vector<WrittenBinding>& written);

    /// From now on, appends the first device's results to a capture.
    void record(GoldenCapture& capture) { recorder_ = &capture; }

private:
    StageComparison& comparison(const std::string& stage);
    /// Whether a range of a buffer holds the same on both devices.
    bool same_words(const BufferView& range);
    double tolerance() const;
    /// Compares the words to which `indices` refer, see KernelBinding::refers_to.
    /// before: the indices before the stage ran.
    void compare_referred(const std::vector<std::uint32_t>& before, const WrittenBinding& indices,
                          const std::vector<WrittenBinding>& written, StageComparison& found);

    Device& a_;
    Device& b_;
    Pairing pairing_;
    DeviceInfo info_;
    std::unique_ptr<Primitives> primitives_;
    std::vector<StageComparison> comparisons_;
    GoldenCapture* recorder_ = nullptr;
    std::vector<std::byte> piece_a_, piece_b_; ///< of same_words()
};

} // namespace argand
