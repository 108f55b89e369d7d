#pragma once

#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace argand {

/// What a user is told: one line that says what was done, to what, what is wrong and what to do.
/// Exit status 1.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A command line that asks for something that does not exist. Exit status 2.
struct UsageError : Error {
    using Error::Error;
};

/// A device that stopped working while it was opened or used; one of another backend may do.
struct DeviceFault : Error {
    DeviceFault(std::string of, const std::string& message)
        : Error(message), backend(std::move(of)) {}

    std::string backend;
};

/// Throws Error with a formatted message.
template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(fmt::format(format, std::forward<Args>(args)...));
}

} // namespace argand
