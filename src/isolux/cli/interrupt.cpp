#include "isolux/cli/interrupt.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "isolux/base/check.h"

namespace isolux {

namespace {

// A signal handler is handed nothing but the signal's number, so what it needs is global.
std::atomic<int> signals_seen{0};
std::atomic<int> wake_descriptor{-1};
static_assert(std::atomic<int>::is_always_lock_free);

/// Only calls that are safe in a handler: atomics, write, _exit.
void handle_signal(int) noexcept {
    const int saved = errno;
    if (signals_seen.fetch_add(1) > 0)
        _exit(130);
    const char byte = 's';
    if (write(wake_descriptor.load(), &byte, 1) < 0)
        _exit(130); // nobody can be woken: stop the hard way
    errno = saved;
}

} // namespace

struct InterruptGuard::Implementation {
    std::array<int, 2> pipe{-1, -1}; ///< the handler writes, the watcher reads

    struct sigaction old_interrupt {};

    struct sigaction old_terminate {};

    std::stop_source source;
    std::thread watcher;
};

InterruptGuard::InterruptGuard() : implementation_(std::make_unique<Implementation>()) {
    Implementation& self = *implementation_;
    ISOLUX_EXPECT(wake_descriptor.load() == -1);
    if (pipe2(self.pipe.data(), O_CLOEXEC) != 0)
        throw std::system_error(errno, std::generic_category(), "pipe");
    wake_descriptor = self.pipe[1];
    signals_seen = 0;
    self.watcher = std::thread([read_end = self.pipe[0], source = self.source]() mutable {
        char byte = 0;
        while (read(read_end, &byte, 1) < 0 && errno == EINTR) {
        }
        if (byte == 's')
            source.request_stop();
    });

    struct sigaction action {};

    action.sa_handler = handle_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, &self.old_interrupt);
    sigaction(SIGTERM, &action, &self.old_terminate);
}

InterruptGuard::~InterruptGuard() {
    Implementation& self = *implementation_;
    sigaction(SIGINT, &self.old_interrupt, nullptr);
    sigaction(SIGTERM, &self.old_terminate, nullptr);
    wake_descriptor = -1;
    close(self.pipe[1]); // the watcher reads the end of the pipe and goes home
    self.watcher.join();
    close(self.pipe[0]);
}

std::stop_token InterruptGuard::token() const noexcept {
    return implementation_->source.get_token();
}

} // namespace isolux
