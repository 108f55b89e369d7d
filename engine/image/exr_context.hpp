#pragma once

#include <cstdint>
#include <openexr.h>
#include <span>
#include <string>
#include <vector>

namespace argand {

/// A file in memory that OpenEXR's C library reads or writes. Any failed call throws an Error that
/// gives the first reason that the library reported; std::bad_alloc if memory ran out.
///
/// The C library, not the C++ one, because it checks every size that a file states against the
/// length of the file before it allocates.
class ExrContext {
public:
    /// `task` begins every error message: "cannot read 'a.exr'"; `advice` ends it.
    ExrContext(std::string task, std::string advice);
    ~ExrContext();
    ExrContext(const ExrContext&) = delete;
    ExrContext& operator=(const ExrContext&) = delete;

    /// Parses the header of `bytes`, which must outlive this object.
    void start_reading(std::span<const std::uint8_t> bytes);

    void start_writing();

    /// Completes a file that was written and returns its bytes. No other call may follow.
    std::vector<std::uint8_t> finish_writing();

    /// Throws unless `result` says that the call succeeded.
    void check(exr_result_t result) const;

    const std::string& task() const { return task_; }
    operator exr_context_t() const { return context_; }

private:
    struct Callbacks;

    std::string task_, advice_;
    std::string reason_; ///< the first that the library reported
    std::span<const std::uint8_t> input_;
    std::vector<std::uint8_t> output_;
    exr_context_initializer_t settings_ = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context_ = nullptr;
};

} // namespace argand
