#include "child_process.hpp"

#include "base/interrupt.hpp"
#include "base/text.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

extern char** environ;

namespace argand {

namespace {

[[noreturn]] void throw_code(int code) { throw std::system_error(code, std::generic_category()); }

void throw_if_code(int code) {
    if (code != 0) {
        throw_code(code);
    }
}

Descriptor above_standard_ones(const Descriptor& low) {
    const int descriptor = ::fcntl(low.get(), F_DUPFD_CLOEXEC, 3);
    if (descriptor < 0) {
        throw_code(errno);
    }
    return Descriptor(descriptor);
}

struct Pipe {
    Descriptor read, write;
};

Pipe open_pipe() {
    int ends[2];
    if (::pipe(ends) != 0) {
        throw_code(errno);
    }
    const Descriptor read(ends[0]), write(ends[1]);
    return {above_standard_ones(read), above_standard_ones(write)};
}

void never_block(const Descriptor& descriptor) {
    if (::fcntl(descriptor.get(), F_SETFL, O_NONBLOCK) != 0) {
        throw_code(errno);
    }
}

struct SpawnActions {
    posix_spawn_file_actions_t list;
    SpawnActions() { throw_if_code(::posix_spawn_file_actions_init(&list)); }
    ~SpawnActions() { ::posix_spawn_file_actions_destroy(&list); }
    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;
};

struct SpawnAttributes {
    posix_spawnattr_t list;
    SpawnAttributes() { throw_if_code(::posix_spawnattr_init(&list)); }
    ~SpawnAttributes() { ::posix_spawnattr_destroy(&list); }
    SpawnAttributes(const SpawnAttributes&) = delete;
    SpawnAttributes& operator=(const SpawnAttributes&) = delete;
};

/// Starts a program in a process group of its own, so that Ctrl-C does not reach it.
pid_t start(std::vector<std::string>& command, const Descriptor& input, const Descriptor& errors) {
    SpawnActions actions;
    throw_if_code(::posix_spawn_file_actions_adddup2(&actions.list, input.get(), STDIN_FILENO));
    throw_if_code(
        ::posix_spawn_file_actions_addopen(&actions.list, STDOUT_FILENO, "/dev/null", O_WRONLY, 0));
    throw_if_code(::posix_spawn_file_actions_adddup2(&actions.list, errors.get(), STDERR_FILENO));
    SpawnAttributes attributes;
    sigset_t ignored_here;
    sigemptyset(&ignored_here);
    sigaddset(&ignored_here, SIGPIPE);
    throw_if_code(::posix_spawnattr_setsigdefault(&attributes.list, &ignored_here));
    throw_if_code(::posix_spawnattr_setpgroup(&attributes.list, 0));
    throw_if_code(::posix_spawnattr_setflags(&attributes.list,
                                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF));
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) {
        arguments.push_back(argument.data());
    }
    arguments.push_back(nullptr);
    pid_t process = -1;
    throw_if_code(::posix_spawnp(&process, arguments[0], &actions.list, &attributes.list,
                                 arguments.data(), environ));
    return process;
}

std::string_view last_line(std::string_view text) {
    text = text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
    return text.substr(text.find_last_of("\r\n") + 1); // npos + 1 is 0
}

} // namespace

Descriptor::Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
}

void Descriptor::close() {
    if (value_ >= 0) {
        ::close(std::exchange(value_, -1));
    }
}

ChildProcess::ChildProcess(std::vector<std::string> command) {
    std::signal(SIGPIPE, SIG_IGN);
    Pipe input = open_pipe(), errors = open_pipe();
    never_block(input.write);
    never_block(errors.read);
    process_ = start(command, input.read, errors.write);
    input_ = std::move(input.write);
    errors_ = std::move(errors.read);
}

ChildProcess::~ChildProcess() {
    if (process_ >= 0) {
        ::kill(-process_, SIGKILL);
        while (::waitpid(process_, &status_, 0) < 0 && errno == EINTR) {
        }
    }
}

bool ChildProcess::send(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t most_at_once = 1 << 20;
    while (!bytes.empty()) {
        const ssize_t sent =
            ::write(input_.get(), bytes.data(), std::min(bytes.size(), most_at_once));
        if (sent >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(sent));
        } else if (errno == EAGAIN) {
            if (interrupted()) {
                return false;
            }
            watch(true);
        } else if (errno != EINTR) {
            return false;
        }
    }
    return true;
}

bool ChildProcess::wait() {
    input_.close();
    while (process_ >= 0) {
        const pid_t ended = ::waitpid(process_, &status_, WNOHANG);
        if (ended == process_) {
            process_ = -1;
        } else if (interrupted()) {
            return false;
        } else {
            watch(false);
        }
    }
    read_errors();
    return true;
}

std::string ChildProcess::failure() const {
    if (WIFSIGNALED(status_)) {
        return fmt::format("it was ended by signal {}", WTERMSIG(status_));
    }
    if (WEXITSTATUS(status_) == 0) {
        return "";
    }
    const std::string line = one_line(last_line(said_));
    return line.empty() ? fmt::format("it ended with status {}", WEXITSTATUS(status_)) : line;
}

/// Reads what the program says until it says no more for now, or, if `for_input`, takes input, or a
/// moment has passed. (A program whose errors nobody reads would stop.)
void ChildProcess::watch(bool for_input) {
    constexpr int moment = 20; // milliseconds
    // poll() passes over negative descriptors.
    pollfd files[] = {{for_input ? input_.get() : -1, POLLOUT, 0}, {errors_.get(), POLLIN, 0}};
    if (::poll(files, 2, moment) > 0 && files[1].revents != 0) {
        read_errors();
    }
}

void ChildProcess::read_errors() {
    constexpr std::size_t most_kept = 4096;
    char bytes[4096];
    while (errors_.get() >= 0) {
        const ssize_t size = ::read(errors_.get(), bytes, sizeof bytes);
        if (size > 0) {
            said_.append(bytes, static_cast<std::size_t>(size));
            said_.erase(0, said_.size() - std::min(said_.size(), most_kept));
        } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
            errors_.close();
        } else if (errno == EAGAIN) {
            return;
        }
    }
}

} // namespace argand
