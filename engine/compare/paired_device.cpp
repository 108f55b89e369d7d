#include "compare/paired_device.hpp"

#include "compare/paired_primitives.hpp"
#include "compare/stage.hpp"
#include "compare/unordered.hpp"

#include <algorithm>
#include <chrono>

namespace argand {

namespace {

// What memory holds before anything is written, the same on either device.
constexpr std::uint32_t undefined_word = 0xcdcdcdcdu;

PairedBuffer& paired(const Buffer& buffer) { return static_cast<PairedBuffer&>(*buffer.storage()); }

BufferView view(const BufferView& of, Buffer PairedBuffer::* side) {
    return BufferView(paired(*of.buffer).*side, of.offset, of.size > 0 ? of.size : of.buffer->size() - of.offset);
}

KernelArguments side_of(KernelArguments arguments, Buffer PairedBuffer::* side) {
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        arguments.buffers[i] = &(paired(*arguments.buffers[i]).*side);
    }
    return arguments;
}

double seconds_of(Device& device, const std::function<void()>& work) {
    device.wait();
    const auto start = std::chrono::steady_clock::now();
    work();
    device.wait();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<std::uint32_t> words_of(Device& device, const BufferView& range) {
    return download<std::uint32_t>(device, *range.buffer, range.size / sizeof(std::uint32_t),
                                   range.offset / sizeof(std::uint32_t));
}

} // namespace

PairedDevice::PairedDevice(Device& a, Device& b, Pairing pairing)
    : a_(a), b_(b), pairing_(pairing), info_(a.info()), primitives_(make_paired_primitives(*this, a, b)) {
    // What kernels must do without on one of them, they do without on both.
    info_.driver += " and " + b.info().driver;
    info_.limits.storage_range = std::min(a.info().limits.storage_range, b.info().limits.storage_range);
    info_.limits.memory = std::min(a.info().limits.memory, b.info().limits.memory);
}

PairedDevice::~PairedDevice() = default;

Buffer PairedDevice::allocate(std::string name, std::uint64_t bytes) {
    auto storage = std::make_shared<PairedBuffer>();
    storage->name = name;
    storage->size = bytes;
    storage->a = a_.allocate(name, bytes);
    storage->b = b_.allocate(std::move(name), bytes);
    Buffer buffer(std::move(storage));
    fill(buffer, undefined_word);
    return buffer;
}

void PairedDevice::upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) {
    a_.upload(paired(to).a, offset, data);
    b_.upload(paired(to).b, offset, data);
}

void PairedDevice::fill(const BufferView& to, std::uint32_t value) {
    a_.fill(view(to, &PairedBuffer::a), value);
    b_.fill(view(to, &PairedBuffer::b), value);
}

void PairedDevice::copy(const BufferView& from, const BufferView& to) {
    a_.copy(view(from, &PairedBuffer::a), view(to, &PairedBuffer::a));
    b_.copy(view(from, &PairedBuffer::b), view(to, &PairedBuffer::b));
}

StageComparison& PairedDevice::comparison(const std::string& stage) {
    const auto found = std::find_if(comparisons_.begin(), comparisons_.end(),
                                    [&](const StageComparison& comparison) { return comparison.name == stage; });
    if (found != comparisons_.end()) {
        return *found;
    }
    comparisons_.push_back({.name = stage});
    return comparisons_.back();
}

void PairedDevice::run(const std::string& stage, const std::function<void()>& on_a, const std::function<void()>& on_b,
                       const std::vector<WrittenBinding>& written) {
    std::vector<std::vector<std::uint32_t>> before;
    if (recorder_) {
        for (const WrittenBinding& binding : written) {
            before.push_back(words_of(a_, view(binding.view, &PairedBuffer::a)));
        }
    }
    StageComparison& found = comparison(stage);
    ++found.runs;
    found.seconds_a += seconds_of(a_, on_a);
    found.seconds_b += seconds_of(b_, on_b);
    GoldenStep step{stage, {}};
    for (std::size_t i = 0; i < written.size(); ++i) {
        const WrittenBinding& binding = written[i];
        const BufferView in_b = view(binding.view, &PairedBuffer::b);
        std::vector<std::uint32_t> a = words_of(a_, view(binding.view, &PairedBuffer::a));
        std::vector<std::uint32_t> b = words_of(b_, in_b);
        if (recorder_) {
            step.writes.push_back(changes(before[i], a));
        }
        if (a == b) {
            found.items += a.size() / binding.layout.size();
            continue;
        }
        if (pairing_ == Pairing::isolated) {
            b_.upload(*in_b.buffer, in_b.offset, std::as_bytes(std::span(a)));
        }
        if (!is_incidental(stage, binding.name)) {
            put_in_order(stage, binding.name, a);
            put_in_order(stage, binding.name, b);
            compare_items(a, b, binding.layout, found);
        }
    }
    if (recorder_) {
        recorder_->push_back(std::move(step));
    }
}

void PairedDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments, std::uint64_t threads) {
    run(stage_name(kernel), [&] { a_.dispatch(kernel, side_of(arguments, &PairedBuffer::a), threads); },
        [&] { b_.dispatch(kernel, side_of(arguments, &PairedBuffer::b), threads); },
        written_bindings(kernel, arguments));
}

void PairedDevice::dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments, const Buffer& counts,
                                     std::uint32_t count_index) {
    const auto threads = argand::download<std::uint32_t>(a_, paired(counts).a, 1, count_index);
    dispatch(kernel, arguments, threads.front());
}

void PairedDevice::wait() {
    a_.wait();
    b_.wait();
}

void PairedDevice::download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    a_.download(paired(from).a, offset, data);
}

} // namespace argand
