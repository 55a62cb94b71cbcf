/// Tracks that drive a simulated body's base: what is read is smooth and finite.
#include "fuzz.h"
#include "simulation/integrator.h"
#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct base_drive drive = {.size = 1};
    const bool good = drive_read_track(&drive, fuzz_file("track.csv", data, size), &error);
    fuzz_expect(good == (error.kind == ERROR_NONE), "a track is refused with a sentence");
    for (int i = 0; good && i < drive.count; i++) {
        fuzz_expect(isfinite(drive_place(&drive, drive.time[i])), "a track's places are finite");
        fuzz_expect(isfinite(drive_acceleration(&drive, drive.time[i])), "a track's accelerations are finite");
    }
    drive_free(&drive);
    return 0;
}
