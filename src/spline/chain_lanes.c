/// How many chains fit side by side in the vectors of this processor.
#include "spline/chain_lanes.h"

int chain_lanes(void)
{
#if defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("avx512f") ? 8 : __builtin_cpu_supports("avx2") ? 4 : 0;
#else
    return 4;
#endif
}
