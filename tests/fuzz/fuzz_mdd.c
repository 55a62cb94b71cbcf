/// Motions in .mdd.
#include "motion.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_motion(fuzz_file("fuzz.mdd", data, size));
    return 0;
}
