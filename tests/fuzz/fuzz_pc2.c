/// Motions in .pc2.
#include "motion.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_motion(fuzz_file("fuzz.pc2", data, size));
    return 0;
}
