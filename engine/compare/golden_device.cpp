#include "compare/golden_device.hpp"

#include "base/error.hpp"
#include "compare/stage.hpp"

namespace argand {

namespace {

DeviceInfo info_of(const Golden& golden) {
    DeviceInfo info = host::describe();
    info.backend = "golden";
    info.name = golden.device;
    info.driver = golden.driver;
    info.features = golden.features;
    return info;
}

class GoldenPrimitives final : public Primitives {
public:
    explicit GoldenPrimitives(GoldenDevice& device) : device_(device) {}

    void sort(const Buffer& keys, const Buffer& values, const Count&, std::uint32_t,
              std::uint32_t) override {
        if (values) {
            device_.play(sort_stage, std::array<BufferView, 2>{keys, values});
        } else {
            device_.play(sort_stage, std::array<BufferView, 1>{keys});
        }
    }
    void scan(const Buffer&, const Buffer& out, const Count&, bool) override {
        play(scan_stage, out);
    }
    void segmented_scan(const Buffer&, const Buffer&, const Buffer& out, const Count&) override {
        play(segmented_scan_stage, out);
    }
    void reduce(const Buffer&, const Buffer& out, std::uint32_t, const Count&,
                std::uint32_t) override {
        play(reduce_stage, out);
    }
    void reduce_box(const Buffer&, const Buffer& out, std::uint32_t, const Count&) override {
        play(reduce_box_stage, out);
    }
    void compact(const Buffer&, const Buffer&, const Buffer& out, const Buffer& counts,
                 std::uint32_t, const Count&) override {
        device_.play(compact_stage, std::array<BufferView, 2>{out, counts});
    }

private:
    void play(const char* stage, const Buffer& out) {
        device_.play(stage, std::array<BufferView, 1>{out});
    }

    GoldenDevice& device_;
};

} // namespace

GoldenDevice::GoldenDevice(const Golden& golden, const GoldenCapture& capture)
    : HostDevice(info_of(golden)), capture_(capture),
      primitives_(std::make_unique<GoldenPrimitives>(*this)) {}

void GoldenDevice::play(const std::string& stage, std::span<const BufferView> written) {
    if (next_ == capture_.size() || capture_[next_].stage != stage ||
        capture_[next_].writes.size() != written.size()) {
        fail("comparing with a golden capture: step {} was {}, not {}; it was recorded from "
             "another scene or version, record it anew",
             next_ + 1, next_ < capture_.size() ? capture_[next_].stage : "none", stage);
    }
    for (std::size_t i = 0; i < written.size(); ++i) {
        apply_changes(capture_[next_].writes[i], host::words_of(written[i]));
    }
    ++next_;
}

void GoldenDevice::expect_end() const {
    if (next_ != capture_.size()) {
        fail("comparing with a golden capture: step {}, {}, was not run; it was recorded from "
             "another scene or version, record it anew",
             next_ + 1, capture_[next_].stage);
    }
}

void GoldenDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                            std::uint64_t) {
    std::vector<BufferView> written;
    for (const WrittenBinding& binding : written_bindings(kernel, arguments)) {
        written.push_back(binding.view);
    }
    play(kernel.stage, written);
}

} // namespace argand
