#include "base/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <unistd.h>

namespace argand {

namespace {

std::atomic<bool> signalled{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may use nothing else");

void note_signal(int signal) {
    if (signalled.exchange(true)) {
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

bool interrupted() { return signalled.load(std::memory_order_relaxed); }

void forget_interrupt() { signalled.store(false); }

} // namespace argand
