#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>

#include "isolux/cli/interrupt.h"

namespace isolux {
namespace {

bool wait_for_stop(const InterruptGuard& guard) {
    for (int i = 0; i < 1000 && !guard.is_interrupted(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    return guard.is_interrupted();
}

TEST(InterruptGuard, TurnsTheFirstSignalIntoAStopRequest) {
    for (const int signal : {SIGINT, SIGTERM}) {
        const InterruptGuard guard; // twice in a row: the first leaves nothing behind
        EXPECT_FALSE(guard.is_interrupted());
        std::raise(signal);
        EXPECT_TRUE(wait_for_stop(guard));
    }
}

TEST(InterruptGuardDeathTest, EndsTheProcessOnTheSecondSignal) {
    EXPECT_EXIT(
        {
            const InterruptGuard guard;
            std::raise(SIGINT);
            std::raise(SIGINT);
        },
        testing::ExitedWithCode(130),
        "");
}

TEST(InterruptGuardDeathTest, GivesSignalsBackWhenItGoes) {
    EXPECT_EXIT(
        {
            { const InterruptGuard guard; }
            std::raise(SIGINT);
        },
        testing::KilledBySignal(SIGINT),
        "");
}

} // namespace
} // namespace isolux
