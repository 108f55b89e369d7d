#include "image/exr_context.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

namespace argand {

/// Functions that the library, which is C, calls: they must not throw. `data` is the ExrContext.
struct ExrContext::Callbacks {
    static void note_reason(exr_const_context_t context, exr_result_t, const char* message) noexcept
        try {
        void* data = nullptr;
        exr_get_user_data(context, &data);
        if (auto* self = static_cast<ExrContext*>(data);
            self != nullptr && self->reason_.empty() && message != nullptr) {
            self->reason_ = one_line(message);
        }
    } catch (...) {
        // `check` then gives the library's general message for the error.
    }

    static std::int64_t size(exr_const_context_t, void* data) noexcept {
        return static_cast<std::int64_t>(static_cast<const ExrContext*>(data)->input_.size());
    }

    static std::int64_t read(exr_const_context_t, void* data, void* buffer, std::uint64_t size,
                             std::uint64_t offset, exr_stream_error_func_ptr_t) noexcept {
        const std::span<const std::uint8_t> input = static_cast<const ExrContext*>(data)->input_;
        if (offset >= input.size()) {
            return 0;
        }
        const std::size_t count = std::min<std::size_t>(size, input.size() - offset);
        std::memcpy(buffer, input.data() + offset, count);
        return static_cast<std::int64_t>(count);
    }

    static std::int64_t write(exr_const_context_t, void* data, const void* buffer,
                              std::uint64_t size, std::uint64_t offset,
                              exr_stream_error_func_ptr_t) noexcept try {
        std::vector<std::uint8_t>& output = static_cast<ExrContext*>(data)->output_;
        output.resize(std::max<std::size_t>(output.size(), offset + size));
        std::memcpy(output.data() + offset, buffer, size);
        return static_cast<std::int64_t>(size);
    } catch (const std::bad_alloc&) {
        return -1;
    }
};

ExrContext::ExrContext(std::string task, std::string advice)
    : task_(std::move(task)), advice_(std::move(advice)) {
    settings_.error_handler_fn = &Callbacks::note_reason;
    settings_.user_data = this;
    // An incomplete file is an error, not something to be repaired.
    settings_.flags =
        EXR_CONTEXT_FLAG_STRICT_HEADER | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
}

ExrContext::~ExrContext() {
    if (context_ != nullptr) {
        exr_finish(&context_);
    }
}

void ExrContext::start_reading(std::span<const std::uint8_t> bytes) {
    input_ = bytes;
    settings_.read_fn = &Callbacks::read;
    settings_.size_fn = &Callbacks::size;
    check(exr_start_read(&context_, "image", &settings_)); // the library demands a name
}

void ExrContext::start_writing() {
    settings_.write_fn = &Callbacks::write;
    check(exr_start_write(&context_, "image", EXR_WRITE_FILE_DIRECTLY, &settings_));
}

std::vector<std::uint8_t> ExrContext::finish_writing() {
    check(exr_finish(&context_));
    return std::move(output_);
}

void ExrContext::check(exr_result_t result) const {
    if (result == EXR_ERR_OUT_OF_MEMORY) {
        throw std::bad_alloc();
    }
    if (result != EXR_ERR_SUCCESS) {
        fail("{}: {}; {}", task_, reason_.empty() ? exr_get_default_error_message(result) : reason_,
             advice_);
    }
}

} // namespace argand
