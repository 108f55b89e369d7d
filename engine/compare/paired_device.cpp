#include "compare/paired_device.hpp"

#include "base/clock.hpp"
#include "compare/paired_primitives.hpp"
#include "compare/stage.hpp"
#include "compare/unordered.hpp"

#include <algorithm>
#include <cstring>

namespace argand {

namespace {

// Items diverge above this relative difference; one rounding error stays below it.
constexpr double isolated_divergence = 1e-5;
constexpr double end_to_end_divergence = 1e-3;
// Larger downloads are data, smaller ones are counts by which the host decides.
constexpr std::size_t most_decision_bytes = 256;

PairedBuffer& paired(const Buffer& buffer) { return static_cast<PairedBuffer&>(*buffer.storage()); }

BufferView view(const BufferView& of, Buffer PairedBuffer::*side) {
    return BufferView(paired(*of.buffer).*side, of.offset,
                      of.size > 0 ? of.size : of.buffer->size() - of.offset);
}

KernelArguments side_of(KernelArguments arguments, Buffer PairedBuffer::*side) {
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        arguments.buffers[i] = &(paired(*arguments.buffers[i]).*side);
    }
    return arguments;
}

double seconds_of(Device& device, const std::function<void()>& work) {
    device.wait();
    const Clock::time_point start = Clock::now();
    work();
    device.wait();
    return seconds_since(start);
}

std::vector<std::uint32_t> words_of(Device& device, const BufferView& range) {
    return download<std::uint32_t>(device, *range.buffer, range.size / sizeof(std::uint32_t),
                                   range.offset / sizeof(std::uint32_t));
}

} // namespace

PairedDevice::PairedDevice(Device& a, Device& b, Pairing pairing)
    : a_(a), b_(b), pairing_(pairing), info_(a.info()),
      primitives_(make_paired_primitives(*this, a, b)) {
    // Kernels use only what both devices offer. What rasterisers draw is not the same everywhere.
    info_.features.raster = false;
    info_.driver += " and " + b.info().driver;
    info_.limits.storage_range =
        std::min(a.info().limits.storage_range, b.info().limits.storage_range);
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
    const auto found =
        std::find_if(comparisons_.begin(), comparisons_.end(),
                     [&](const StageComparison& comparison) { return comparison.name == stage; });
    if (found != comparisons_.end()) {
        return *found;
    }
    comparisons_.push_back({.name = stage});
    return comparisons_.back();
}

// Most buffers are equal, and some have a hundred megabytes: they are read piece by piece, so that
// no command takes memory of their size.
bool PairedDevice::same_words(const BufferView& range) {
    constexpr std::uint64_t piece = std::uint64_t{1} << 22;
    const BufferView a = view(range, &PairedBuffer::a), b = view(range, &PairedBuffer::b);
    for (std::uint64_t at = 0; at < a.size; at += piece) {
        const std::uint64_t bytes = std::min(piece, a.size - at);
        piece_a_.resize(bytes);
        piece_b_.resize(bytes);
        a_.download(*a.buffer, a.offset + at, piece_a_);
        b_.download(*b.buffer, b.offset + at, piece_b_);
        // The vectors' own comparison goes byte by byte.
        if (std::memcmp(piece_a_.data(), piece_b_.data(), bytes) != 0) {
            return false;
        }
    }
    return true;
}

void PairedDevice::run(const std::string& stage, const std::function<void()>& on_a,
                       const std::function<void()>& on_b,
                       const std::vector<WrittenBinding>& written) {
    const auto indices =
        std::find_if(written.begin(), written.end(),
                     [](const WrittenBinding& binding) { return binding.how.refers_to >= 0; });
    std::vector<std::vector<std::uint32_t>> before;
    if (recorder_ || indices != written.end()) {
        for (const WrittenBinding& binding : written) {
            before.push_back(words_of(a_, view(binding.view, &PairedBuffer::a)));
        }
    }
    StageComparison& found = comparison(stage);
    ++found.runs;
    found.seconds_a += seconds_of(a_, on_a);
    found.seconds_b += seconds_of(b_, on_b);
    if (indices != written.end()) {
        compare_referred(before[static_cast<std::size_t>(indices - written.begin())], *indices,
                         written, found);
    }
    GoldenStep step{stage, {}};
    for (std::size_t i = 0; i < written.size(); ++i) {
        const WrittenBinding& binding = written[i];
        const BufferView in_a = view(binding.view, &PairedBuffer::a);
        const BufferView in_b = view(binding.view, &PairedBuffer::b);
        const std::string_view layout = binding.how.words;
        const bool counts = !binding.how.incidental && binding.how.refers_to < 0;
        if (recorder_) {
            step.writes.push_back(changes(before[i], words_of(a_, in_a)));
        }
        if (same_words(binding.view)) {
            found.items += counts ? in_a.size / sizeof(std::uint32_t) / layout.size() : 0;
            continue;
        }
        std::vector<std::uint32_t> a = words_of(a_, in_a);
        std::vector<std::uint32_t> b = words_of(b_, in_b);
        // Appended records that a later, shorter run leaves behind would otherwise differ by the
        // order in which they were appended.
        const bool same_records = are_same_records(binding.how.unordered, a, b);
        if (pairing_ == Pairing::isolated || same_records) {
            b_.upload(*in_b.buffer, in_b.offset, std::as_bytes(std::span(a)));
        }
        if (counts) {
            put_in_order(binding.how.unordered, a);
            put_in_order(binding.how.unordered, b);
            compare_items(a, b, layout, tolerance(), found);
        }
    }
    if (recorder_) {
        recorder_->push_back(std::move(step));
    }
}

double PairedDevice::tolerance() const {
    return pairing_ == Pairing::isolated ? isolated_divergence : end_to_end_divergence;
}

void PairedDevice::compare_referred(const std::vector<std::uint32_t>& before,
                                    const WrittenBinding& indices,
                                    const std::vector<WrittenBinding>& written,
                                    StageComparison& found) {
    const auto is_target = [&](const WrittenBinding& binding) {
        return static_cast<int>(binding.how.binding) == indices.how.refers_to;
    };
    const auto targets = std::find_if(written.begin(), written.end(), is_target);
    if (targets == written.end()) {
        return; // another binding has the same buffer
    }
    const auto read = [&](Device& device, Buffer PairedBuffer::*side) {
        return IndexedWords{words_of(device, view(indices.view, side)),
                            words_of(device, view(targets->view, side))};
    };
    const IndexedWords a = read(a_, &PairedBuffer::a);
    const IndexedWords b = read(b_, &PairedBuffer::b);
    std::vector<std::uint32_t> words_a, words_b;
    for (std::size_t i = 0; i < before.size(); ++i) {
        // Indices that neither device has written are left from earlier runs.
        if (a.indices[i] != before[i] || b.indices[i] != before[i]) {
            words_a.push_back(referred_word(a, i));
            words_b.push_back(referred_word(b, i));
        }
    }
    compare_items(words_a, words_b, "u", tolerance(), found);
}

void PairedDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                            std::uint64_t threads) {
    run(
        kernel.stage, [&] { a_.dispatch(kernel, side_of(arguments, &PairedBuffer::a), threads); },
        [&] { b_.dispatch(kernel, side_of(arguments, &PairedBuffer::b), threads); },
        written_bindings(kernel, arguments));
}

void PairedDevice::dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                     const Buffer& counts, std::uint32_t count_index) {
    const auto on = [&](Device& device, Buffer PairedBuffer::*side) {
        return
            [&kernel, &device, arguments = side_of(arguments, side), count = paired(counts).*side,
             count_index] { device.dispatch_indirect(kernel, arguments, count, count_index); };
    };
    run(kernel.stage, on(a_, &PairedBuffer::a), on(b_, &PairedBuffer::b),
        written_bindings(kernel, arguments));
}

void PairedDevice::wait() {
    a_.wait();
    b_.wait();
}

void PairedDevice::download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    a_.download(paired(from).a, offset, data);
    if (data.size() > most_decision_bytes || data.size() % sizeof(std::uint32_t) != 0) {
        return;
    }
    std::vector<std::uint32_t> a(data.size() / sizeof(std::uint32_t)), b(a.size());
    std::memcpy(a.data(), data.data(), data.size());
    b_.download(paired(from).b, offset, std::as_writable_bytes(std::span(b)));
    StageComparison& found = comparison("counts read");
    ++found.runs;
    compare_items(a, b, "u", tolerance(), found);
}

} // namespace argand
