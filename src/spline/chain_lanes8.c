/// 8 chains at once; compiled for avx512f where the processor has it (see chain_lanes_loop.h).
#if defined(__x86_64__) && defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f"))), apply_to = function)
#elif defined(__x86_64__) && defined(__GNUC__)
#pragma GCC target("avx512f")
#endif
#define LANES 8
#define chain_solve_by_lanes chain_solve_by_8
#include "spline/chain_lanes_loop.h"
#if defined(__x86_64__) && defined(__clang__)
#pragma clang attribute pop
#endif
