/// Replays: a recording of a replay's events plays the same events.
#include "app/replay.h"
#include "fuzz.h"
#include <stdlib.h>

static bool somewhere(void *user, const char *target, float *x, float *y, struct error *error)
{
    (void)user, (void)error;
    *x = (float)target[0];
    *y = 1;
    return true;
}

/// Plays a file and records what it plays; NULL where it is refused.
static char *recorded(const char *path, size_t *size, struct error *error)
{
    struct replay *replay = replay_load(path, error);
    if (!replay) return NULL;
    char out[160];
    struct event event;
    const struct replay_header *header = replay_get_header(replay);
    snprintf(out, sizeof out, "%s.out", path);
    struct recording *recording = recording_open(out, header, error);
    // Frames without events are many; a replay that goes on much longer than it is large is played to here only.
    for (long frame = 0; frame < header->frames && frame < 4000 && error->kind == ERROR_NONE; frame++) {
        while (replay_next(replay, frame, somewhere, NULL, &event, error)) recording_event(recording, frame, &event);
    }
    bool played = error->kind == ERROR_NONE;
    fuzz_expect(recording_close(recording, header->frames, error), "a recording is written");
    replay_destroy(replay);
    return played ? fuzz_bytes(out, size) : NULL;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t first_size, second_size;
    struct error error = {0};
    char *first = recorded(fuzz_file("replay", data, size), &first_size, &error);
    if (!first) return 0;
    char *second = recorded(fuzz_file("replay", first, first_size), &second_size, &error);
    fuzz_expect(second != NULL, error.text);
    fuzz_same("a recording of a recording is the same", first, first_size, second, second_size);
    free(first);
    free(second);
    return 0;
}
