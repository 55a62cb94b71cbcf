/// What lies beside a simulated motion: what is read can be used.
#include "commands/companion.h"
#include "fuzz.h"
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct companion made;
    char motion[COMPANION_PATH];
    fuzz_expect(companion_path(fuzz_file("fuzz.simulation.json", data, size), "", motion), "a path fits");
    *strrchr(motion, '.') = '\0';
    const bool good = companion_read(motion, 96, 8, &made, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "what lies beside a motion is refused with a sentence");
    fuzz_expect(!good || made.frames == 0 || (made.fps > 0 && made.from >= 0), "its times are some");
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_json(data, size, most, 0, size, seed);
}
