/// Loops that are worth compiling for wider vectors than the build's baseline, chosen for the processor at run time. Each element
/// is computed by the same operations in the same order whatever the width (no sums across lanes, no fused multiply-add), so the
/// result is the same to the last bit.
#ifndef MATHS_WIDE_H
#define MATHS_WIDE_H

// The choice is made before a sanitizer is ready.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) &&                               \
    !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#define WIDEST __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define WIDEST
#endif

/// Where constant arguments make loops of their own.
#define ALWAYS_INLINE static inline __attribute__((always_inline))

#endif
