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

void close_checked(const fs::path& target, int descriptor) {
    if (::close(descriptor) != 0 && errno != EINTR) {
        fail_with_errno(target, errno);
    }
}

void write_directly(const fs::path& target, const fs::path& path,
                    std::span<const std::uint8_t> bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) {
        fail_with_errno(target, errno);
    }
    try {
        write_all(target, descriptor, bytes);
    } catch (...) {
        ::close(descriptor);
        throw;
    }
    close_checked(target, descriptor);
}

} // namespace

Replacement::Replacement(const fs::path& target) : target_(target) {
    const Destination destination = resolve(target);
    if (destination.special) {
        fail_to_write(target, "it is a pipe or a device", "give the name of a file");
    }
    destination_ = destination.path;
    if (destination.exists) {
        mode_ = destination.mode;
    }
    static std::atomic<unsigned> counter{0};
    while (descriptor_ < 0) {
        // Not the target's name with a suffix: it may already have the greatest length allowed.
        path_ =
            destination_.parent_path() / fmt::format(".argand-{}-{}.tmp", ::getpid(), counter++);
        descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0 && errno != EEXIST && errno != EINTR) {
            fail_with_errno(target_, errno);
        }
    }
}

Replacement::~Replacement() {
    if (descriptor_ >= 0) {
        ::close(descriptor_);
    }
    if (!path_.empty()) {
        ::unlink(path_.c_str());
    }
}

void Replacement::put_in_place() {
    // Otherwise a power failure after the rename could leave an empty file.
    if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != ENOTSUP) {
        fail_with_errno(target_, errno);
    }
    if (mode_ && ::fchmod(descriptor_, *mode_) != 0) {
        fail_with_errno(target_, errno);
    }
    close_checked(target_, std::exchange(descriptor_, -1));
    if (::rename(path_.c_str(), destination_.c_str()) != 0) {
        fail_with_errno(target_, errno);
    }
    path_.clear();
}

void Replacement::write(std::span<const std::uint8_t> bytes) {
    write_all(target_, descriptor_, bytes);
}

void write_atomically(const fs::path& target, std::span<const std::uint8_t> bytes) {
    const Destination destination = resolve(target);
    if (destination.special) {
        write_directly(target, destination.path, bytes);
        return;
    }
    Replacement file(target);
    file.write(bytes);
    file.put_in_place();
}

void write_atomically(const fs::path& target, std::string_view text) {
    write_atomically(target,
                     std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_writable(const fs::path& target) {
    if (!resolve(target).special) {
        const Replacement file(target);
    }
}

} // namespace argand
