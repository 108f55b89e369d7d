#pragma once

#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace argand {

/// An error for the user. The message is one line that names the operation, its object, the problem
/// and a remedy. The program exits with status 1.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A mistake on the command line, such as an unknown name. The program exits with status 2.
struct UsageError : Error {
    using Error::Error;
};

/// A failure of a device while it is opened or used. A device of another backend may work.
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
