/// Arrays in .npy: as a motion, and as paint, which reads back as it is written.
#include "motion.h"
#include "scene/paint.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    const char *file = fuzz_file("fuzz.npy", data, size);
    fuzz_motion(file);
    struct paint *paint = paint_read(file, &error);
    if (!paint) return 0;
    fuzz_expect(paint_write(paint, file, &error), error.text);
    struct paint *again = paint_read(file, &error);
    fuzz_expect(again != NULL, error.text);
    fuzz_expect(memcmp(paint->values, again->values, paint_bytes(paint) - sizeof *paint) == 0, "paint reads back");
    paint_drop(paint);
    paint_drop(again);
    return 0;
}
