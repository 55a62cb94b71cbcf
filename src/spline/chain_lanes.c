/// How many chains fit side by side in the vectors of this processor.
#include "spline/chain_lanes.h"

int chain_lanes(void)
{
#ifdef _WIN32
    return 0; // gcc for Windows keeps vectors on a stack that is not aligned for them
#elif defined(__x86_64__) && defined(__GNUC__)
    return __builtin_cpu_supports("avx512f") ? 8 : __builtin_cpu_supports("avx2") ? 4 : 0;
#else
    return 4;
#endif
}
