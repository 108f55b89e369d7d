#pragma once

#include <fcntl.h>
#include <stdlib.h>
#include <string>
#include <unistd.h>

namespace argand::testing {

/// A pseudo-terminal; `read` returns the text printed on it since the last call.
class Terminal {
public:
    Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        if (master_ >= 0 && ::grantpt(master_) == 0 && ::unlockpt(master_) == 0) {
            slave_ = ::open(::ptsname(master_), O_RDWR | O_NOCTTY);
        }
    }
    ~Terminal() {
        ::close(slave_);
        ::close(master_);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    int descriptor() const { return slave_; }
    /// Its file, for other processes.
    std::string name() const { return ::ptsname(master_); }
    std::string read() const {
        std::string text(65536, '\0');
        const ssize_t size = ::read(master_, text.data(), text.size());
        text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
        return text;
    }

private:
    int master_ = -1, slave_ = -1;
};

} // namespace argand::testing
