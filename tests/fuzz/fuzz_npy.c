/// Arrays in .npy: as a motion, and as paint, which reads back as it is saved.
#include "motion.h"
#include "scene/paint_file.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    fuzz_motion(fuzz_file("fuzz.npy", data, size));
    char *file = malloc(size + 1); // as scene_parse_paint() has it: with a NUL behind
    memcpy(file, data, size);
    file[size] = '\0';
    struct paint *paint = paint_parse("fuzz.npy", file, size, &error);
    free(file);
    if (!paint) return 0;
    struct text first = {0}, second = {0};
    paint_print(&first, paint);
    struct paint *again = paint_parse("again.npy", first.data, first.size, &error);
    fuzz_expect(again != NULL, error.text);
    paint_print(&second, again);
    fuzz_same("paint that is saved, loaded and saved is the same", first.data, first.size, second.data, second.size);
    free(first.data);
    free(second.data);
    paint_drop(paint);
    paint_drop(again);
    return 0;
}
