/// 4 chains at once; compiled for avx2 where the processor has it (see chain_lanes_loop.h).
#if defined(__x86_64__) && defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#elif defined(__x86_64__) && defined(__GNUC__)
#pragma GCC target("avx2")
#endif
#define LANES 4
#define chain_solve_by_lanes chain_solve_by_4
#include "spline/chain_lanes_loop.h"
#if defined(__x86_64__) && defined(__clang__)
#pragma clang attribute pop
#endif
