#include "base/atomic_write.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace argand {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_to_write(const fs::path& target, std::string_view reason,
                                std::string_view advice) {
    fail("cannot write '{}': {}; {}", one_line(target.string(), 4096), reason, advice);
}

[[noreturn]] void fail_with_errno(const fs::path& target, int code) {
    std::string_view advice = "check the path and its permissions";
    if (code == ENOSPC || code == EDQUOT || code == EFBIG) {
        advice = "make room or choose another place";
    } else if (code == EROFS) {
        advice = "choose another place";
    }
    fail_to_write(target, std::strerror(code), advice);
}

/// An open file that is closed and, unless `path` was cleared, removed on destruction.
struct Scratch {
    fs::path path;
    int descriptor = -1;

    Scratch() = default;
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() {
        if (descriptor >= 0) {
            ::close(descriptor);
        }
        if (!path.empty()) {
            ::unlink(path.c_str());
        }
    }
};

/// The file to replace: the target after its symbolic links, which stay links.
struct Destination {
    fs::path path;
    bool exists = false;
    bool special = false; ///< a pipe or a device
    mode_t mode = 0;      ///< permissions of the existing file
};

Destination resolve(const fs::path& target) {
    if (target.empty()) {
        fail_to_write(target, "the name is empty", "give a file name");
    }
    Destination destination{.path = target};
    // In a loop of links, stat below fails with ELOOP.
    for (int hop = 0; hop < 40; ++hop) {
        std::error_code none;
        if (!fs::is_symlink(fs::symlink_status(destination.path, none))) {
            break;
        }
        const fs::path link = fs::read_symlink(destination.path, none);
        destination.path = destination.path.parent_path() / link;
    }
    struct stat status {};
    if (::stat(destination.path.c_str(), &status) == 0) {
        destination.exists = true;
        destination.special = !S_ISREG(status.st_mode);
        destination.mode = status.st_mode & 07777;
        if (S_ISDIR(status.st_mode)) {
            fail_to_write(target, "it is a directory", "give a file name");
        }
        if (::faccessat(AT_FDCWD, destination.path.c_str(), W_OK, AT_EACCESS) != 0) {
            fail_to_write(target, "it is write-protected",
                          "change its permissions or choose another name");
        }
        return destination;
    }
    const int code = errno;
    std::error_code none;
    const fs::path parent =
        destination.path.has_parent_path() ? destination.path.parent_path() : fs::path(".");
    if (code == ENOENT && !fs::exists(parent, none)) {
        fail_to_write(
            target,
            fmt::format("the directory '{}' does not exist", one_line(parent.string(), 4096)),
            "create it or choose another place");
    }
    if (code == ENOENT && !destination.path.has_filename()) {
        fail_to_write(target, "it is a directory", "give a file name");
    }
    if (code != ENOENT) {
        fail_with_errno(target, code);
    }
    return destination;
}

/// Creates a file with a new name in the destination's directory.
void open_beside(const fs::path& target, const Destination& destination, Scratch& scratch) {
    static std::atomic<unsigned> counter{0};
    for (;;) {
        // Not the target's name with a suffix: it may already have the greatest length allowed.
        fs::path path = destination.path.parent_path() /
                        fmt::format(".argand-{}-{}.tmp", ::getpid(), counter++);
        const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0) {
            scratch.path = std::move(path);
            scratch.descriptor = descriptor;
            return;
        }
        if (errno != EEXIST && errno != EINTR) {
            fail_with_errno(target, errno);
        }
    }
}

void write_all(const fs::path& target, int descriptor, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written >= 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        } else if (errno != EINTR) {
            fail_with_errno(target, errno);
        }
    }
}

void close_checked(const fs::path& target, Scratch& scratch) {
    const int descriptor = std::exchange(scratch.descriptor, -1);
    if (::close(descriptor) != 0 && errno != EINTR) {
        fail_with_errno(target, errno);
    }
}

} // namespace

void write_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
    const Destination destination = resolve(target);
    Scratch scratch;
    if (destination.special) {
        scratch.descriptor = ::open(destination.path.c_str(), O_WRONLY | O_CLOEXEC);
        if (scratch.descriptor < 0) {
            fail_with_errno(target, errno);
        }
        write_all(target, scratch.descriptor, bytes);
        close_checked(target, scratch);
        return;
    }
    open_beside(target, destination, scratch);
    write_all(target, scratch.descriptor, bytes);
    // Otherwise a power failure after the rename could leave an empty file.
    if (::fsync(scratch.descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) {
        fail_with_errno(target, errno);
    }
    if (destination.exists && ::fchmod(scratch.descriptor, destination.mode) != 0) {
        fail_with_errno(target, errno);
    }
    close_checked(target, scratch);
    if (::rename(scratch.path.c_str(), destination.path.c_str()) != 0) {
        fail_with_errno(target, errno);
    }
    scratch.path.clear();
}

void write_atomically(const fs::path& target, std::string_view text) {
    write_atomically(target,
                     std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_writable(const fs::path& target) {
    const Destination destination = resolve(target);
    if (!destination.special) {
        Scratch scratch;
        open_beside(target, destination, scratch);
    }
}

} // namespace argand
