#pragma once

#include <cstddef>
#include <functional>

namespace isolux {

/// Calls `f(begin, end)` for consecutive ranges that cover [0, count), in parallel. The split
/// into ranges is by `grain` only, never by the number of threads; whoever writes results by
/// index gets the same bits for any number of threads. Each worker runs with denormals flushed
/// to zero.
void for_each_range(std::size_t count,
                    std::size_t grain,
                    const std::function<void(std::size_t begin, std::size_t end)>& f);

/// As above, one index at a time.
template <class F> void for_each_index(std::size_t count, std::size_t grain, F&& f) {
    for_each_range(count, grain, [&f](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            f(i);
    });
}

/// Threads that work may use now: those of the machine, or of the limit in force.
[[nodiscard]] std::size_t allowed_threads() noexcept;

/// Limits the number of worker threads while it lives. 0 means all the machine has.
class ThreadLimit {
public:
    explicit ThreadLimit(std::size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    void* control_ = nullptr;
};

[[nodiscard]] std::size_t hardware_threads() noexcept;

} // namespace isolux
