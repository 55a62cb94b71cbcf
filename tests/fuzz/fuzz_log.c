/// Timing logs.
#include "fuzz.h"
#include "timing/framelog.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct timing_log log;
    bool good = timing_log_read(fuzz_file("log.csv", data, size), &log, &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a log is refused with a sentence");
    if (!good) return 0;
    for (int i = 0; i < log.rows; i++) fuzz_expect(log.run[i] >= 0 && log.run[i] < log.runs, "a row is of a run");
    timing_log_free(&log);
    return 0;
}
