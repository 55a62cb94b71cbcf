/// The host's floating-point state: while the solver works there are no traps, for it meets infinities on purpose, rounding is to nearest and
/// tiny numbers are kept.
#ifndef SPLINE_HOST_H
#define SPLINE_HOST_H

#if defined __SSE2__ && !defined __wasm__ // there they are imitated, without a register for the state
#include <xmmintrin.h>

typedef unsigned host_state;

static inline host_state host_leave(void)
{
    const host_state state = _mm_getcsr();
    _mm_setcsr(0x1f80); // the default
    return state;
}

static inline void host_return(const host_state *state) { _mm_setcsr(*state); }

#else
#include <fenv.h>

typedef fenv_t host_state;

static inline host_state host_leave(void)
{
    host_state state;
    fegetenv(&state);
    fesetenv(FE_DFL_ENV);
    return state;
}

static inline void host_return(const host_state *state) { fesetenv(state); }
#endif

#endif
