#pragma once

#include <cstdio>
#include <cstdlib>

/// Contracts. A broken one is a bug of the caller, never of the user's input: on in development
/// builds (ISOLUX_CHECKS), gone in release.
#if defined(ISOLUX_CHECKS)
#define ISOLUX_CHECK_(kind, condition)                                                         \
    do {                                                                                       \
        if (!(condition)) {                                                                    \
            std::fprintf(                                                                      \
                stderr, "%s:%d: %s violated: %s\n", __FILE__, __LINE__, kind, #condition);     \
            std::abort();                                                                      \
        }                                                                                      \
    } while (false)
#else
#define ISOLUX_CHECK_(kind, condition)                                                         \
    do {                                                                                       \
    } while (false)
#endif

#define ISOLUX_EXPECT(condition) ISOLUX_CHECK_("precondition", condition)
#define ISOLUX_ASSERT(condition) ISOLUX_CHECK_("assertion", condition)
#define ISOLUX_ENSURE(condition) ISOLUX_CHECK_("postcondition", condition)
