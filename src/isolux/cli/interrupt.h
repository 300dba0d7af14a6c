#pragma once

#include <memory>
#include <stop_token>

namespace isolux {

/// While it lives, the first Ctrl-C (SIGINT) or SIGTERM asks politely through token(); a second
/// one ends the process at once with status 130. At most one may live at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] std::stop_token token() const noexcept;

    [[nodiscard]] bool is_interrupted() const noexcept { return token().stop_requested(); }

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

} // namespace isolux
