#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <sys/types.h>
#include <vector>

namespace argand {

/// An open file descriptor above those of standard input, output and error. Programs that are
/// started do not inherit it.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int value) : value_(value) {} ///< takes it over
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    Descriptor(Descriptor&& other) noexcept;
    Descriptor& operator=(Descriptor&& other) noexcept;

    int get() const { return value_; } ///< negative: none
    void close();

private:
    int value_ = -1;
};

/// A program at work on what is sent to its standard input. A signal that the terminal sends to
/// Argand (Ctrl-C) does not reach it. If it is still at work at the end of this object's life, it
/// is killed, and so are the programs that it has started.
class ChildProcess {
public:
    /// Starts a program, command[0], that the PATH has; no shell reads the command. From then on
    /// writing to a pipe that nobody reads is an error in Argand instead of a SIGPIPE. Throws
    /// std::system_error if the program cannot be started: ENOENT if there is none.
    explicit ChildProcess(std::vector<std::string> command);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Sends these bytes. Returns false if not all of them could be sent: the program has closed
    /// its input, or `interrupted()`.
    bool send(std::span<const std::uint8_t> bytes);

    /// Ends its input and waits for its end. Returns false if the program is still at work:
    /// `interrupted()`.
    bool wait();

    /// How it failed, in a line that can be printed: the last line of its standard error, else its
    /// exit status. Empty if it has succeeded. Call it after `wait` has returned true.
    std::string failure() const;

private:
    void watch(bool for_input);
    void read_errors();

    pid_t process_ = -1; ///< also its group; negative: it has ended
    int status_ = 0;     ///< of waitpid
    Descriptor input_, errors_;
    std::string said_; ///< the end of its standard error
};

} // namespace argand
