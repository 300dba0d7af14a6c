#include "isolux/base/parallel.h"

#include <algorithm>
#include <thread>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace isolux {

namespace {

/// Denormals cost a hundred cycles each and carry no light.
void flush_denormals() noexcept {
#if defined(__SSE2__)
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
#endif
}

} // namespace

void for_each_range(std::size_t count,
                    std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& f) {
    if (count == 0)
        return;
    const std::size_t step = std::max<std::size_t>(grain, 1);
    const std::size_t ranges = (count + step - 1) / step;
    tbb::parallel_for(std::size_t{0}, ranges, [&](std::size_t r) {
        flush_denormals();
        f(r * step, std::min(count, (r + 1) * step));
    });
}

ThreadLimit::ThreadLimit(std::size_t threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       threads > 0 ? threads : hardware_threads())) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

std::size_t allowed_threads() noexcept {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

std::size_t hardware_threads() noexcept {
    return std::max<std::size_t>(1, std::thread::hardware_concurrency());
}

} // namespace isolux
