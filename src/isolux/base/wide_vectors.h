#pragma once

// On x86 the same source is compiled twice and the processor chooses; no fused
// arithmetic, so both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)                            \
    && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define ISOLUX_WIDE_VECTORS [[gnu::target_clones("default", "avx2")]]
#define ISOLUX_INLINE [[gnu::always_inline]] inline
#else
#define ISOLUX_WIDE_VECTORS
#define ISOLUX_INLINE inline
#endif
