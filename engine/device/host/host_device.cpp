#include "device/host/host_device.hpp"

#include "base/error.hpp"
#include "base/machine.hpp"
#include "device/twin.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <omp.h>

namespace argand::host {

namespace {

constexpr std::align_val_t alignment{64};
// Invocations that a core takes at a time; neighbours, because they read the same memory.
constexpr std::uint64_t chunk = 64;

std::byte* host(const Buffer& buffer) { return block_of<HostBlock>(buffer).data; }

std::uint64_t size_of(const BufferView& view) {
    return view.size > 0 ? view.size : view.buffer->size() - view.offset;
}

TwinArguments twin_arguments(const KernelArguments& arguments) {
    TwinArguments result;
    for (std::uint32_t i = 0; i < arguments.buffer_count; ++i) {
        result.buffers[i] = host(*arguments.buffers[i]) + arguments.offsets[i];
    }
    std::copy(arguments.push.begin(), arguments.push.end(), result.push);
    std::copy(arguments.constants.begin(), arguments.constants.end(), result.constants);
    return result;
}

} // namespace

std::span<std::uint32_t> words_of(const BufferView& view) {
    return {reinterpret_cast<std::uint32_t*>(host(*view.buffer) + view.offset),
            size_of(view) / sizeof(std::uint32_t)};
}

DeviceInfo describe() {
    DeviceInfo info;
    info.backend = "cpu";
    info.name = processor_name();
    info.driver = fmt::format("{} threads", omp_get_max_threads());
    info.kind = DeviceKind::cpu;
    info.features.timestamps = true;
    info.features.lane_serial = true;
    info.limits.memory = physical_memory();
    info.limits.storage_range = std::min(info.limits.memory, most_addressable);
    // Limits of work-groups do not apply: kernels run without groups here.
    info.limits.invocations = UINT32_MAX;
    info.limits.shared_memory = UINT32_MAX;
    info.limits.storage_buffers = max_bindings;
    info.limits.groups = UINT32_MAX;
    return info;
}

HostBlock::~HostBlock() { ::operator delete(data, alignment); }

Buffer HostDevice::allocate(std::string name, std::uint64_t bytes) {
    check_allocation(info_, memory_->ledger(), name, bytes);
    const auto allocate = [](std::uint64_t size) -> std::unique_ptr<MemoryBlock> {
        auto block = std::make_unique<HostBlock>();
        block->bytes = size;
        block->data = static_cast<std::byte*>(::operator new(size, alignment, std::nothrow));
        return block->data != nullptr ? std::move(block) : nullptr;
    };
    Buffer buffer(memory_->allocate(info_, std::move(name), bytes, allocate));
    if (poisons_) {
        fill(buffer, undefined_word);
    }
    return buffer;
}

void HostDevice::upload(const Buffer& to, std::uint64_t offset, std::span<const std::byte> data) {
    std::copy(data.begin(), data.end(), host(to) + offset);
}

void HostDevice::fill(const BufferView& to, std::uint32_t value) {
    std::ranges::fill(words_of(to), value);
}

void HostDevice::copy(const BufferView& from, const BufferView& to) {
    std::memmove(host(*to.buffer) + to.offset, host(*from.buffer) + from.offset,
                 std::min(size_of(from), size_of(to)));
}

void HostDevice::dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                          std::uint64_t threads) {
    RunOnHost* const run =
        twin_for(kernel, arguments.constants, &KernelInfo::host, &LeanModule::host);
    if (run == nullptr) {
        fail("running kernel {}: it has no twin for backend cpu; please report this", kernel.name);
    }
    check_threads(kernel, threads);
    const TwinArguments twin = twin_arguments(arguments);
    const auto chunks = static_cast<std::int64_t>((threads + chunk - 1) / chunk);
#pragma omp parallel for schedule(dynamic) if (chunks > 1)
    for (std::int64_t i = 0; i < chunks; ++i) {
        const std::uint64_t first = static_cast<std::uint64_t>(i) * chunk;
        run(twin, first, std::min(first + chunk, threads));
    }
}

void HostDevice::dispatch_indirect(const KernelInfo& kernel, const KernelArguments& arguments,
                                   const Buffer& counts, std::uint32_t count_index) {
    std::uint32_t threads = 0;
    std::memcpy(&threads, host(counts) + count_index * sizeof(std::uint32_t), sizeof(threads));
    dispatch(kernel, arguments, threads);
}

void HostDevice::download(const Buffer& from, std::uint64_t offset, std::span<std::byte> data) {
    std::copy_n(host(from) + offset, data.size(), data.begin());
}

void HostDevice::begin_stage(std::string_view name) {
    stage_ = name;
    stage_start_ = Clock::now();
}

void HostDevice::end_stage() {
    if (!info_.features.timestamps) {
        return;
    }
    const double spent = seconds_since(stage_start_);
    auto found = std::find_if(times_.begin(), times_.end(),
                              [&](const StageTime& time) { return time.name == stage_; });
    if (found == times_.end()) {
        found = times_.insert(times_.end(), {stage_, 0, 0});
    }
    found->seconds += spent;
    ++found->runs;
}

} // namespace argand::host
