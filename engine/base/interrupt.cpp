#include "base/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <unistd.h>

namespace argand {

namespace {

// Milliseconds of the monotonic clock at the first signal; 0: there was none.
std::atomic<std::int64_t> first_signal{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may use nothing else");

// `timeout` sends its signal to the program and to its group: two signals that are one.
constexpr std::int64_t one_signal = 500;

void note_signal(int signal) {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    const std::int64_t now = std::int64_t{time.tv_sec} * 1'000 + time.tv_nsec / 1'000'000;
    std::int64_t first = 0;
    if (!first_signal.compare_exchange_strong(first, now) && now - first > one_signal) {
        ::_exit(128 + signal);
    }
}

} // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART; // reads and writes in progress continue
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) {
        // A program that was started with the signal ignored (by nohup, or in the background of a
        // script) keeps ignoring it.
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
            ::sigaction(signal, &action, nullptr);
        }
    }
}

bool interrupted() { return first_signal.load(std::memory_order_relaxed) != 0; }

void forget_interrupt() { first_signal.store(0); }

} // namespace argand
