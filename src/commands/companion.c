/// Reads and writes the file beside a simulated motion.
#include "commands/companion.h"
#include "base/file.h"
#include "base/json.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_LIMIT = 1 << 16 };

bool companion_path(const char *motion, const char *end, char path[COMPANION_PATH])
{
    const char *dot = strrchr(path_name(motion), '.');
    const int stem = (int)(dot ? dot - motion : (long)strlen(motion));
    return snprintf(path, COMPANION_PATH, "%.*s%s", stem, motion, end) < COMPANION_PATH;
}

bool companion_write(const char *motion, const struct companion *c, struct error *error)
{
    char path[COMPANION_PATH];
    struct file_output output;
    if (!companion_path(motion, ".simulation.json", path) || !file_output_open(&output, path, error)) return false;
    json_t *object = json_pack("{si si si sf s[fff] sf ss sb}", "simulation", 1, "frames", c->frames, "vertices",
                               c->vertices, "fps", c->fps, "shake", c->shake[0], c->shake[1], c->shake[2], "from",
                               c->from, "pin", c->pin, "world", c->world);
    json_dumpf(object, output.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    fputc('\n', output.stream);
    json_decref(object);
    return file_output_commit(&output, error);
}

/// Whether the numbers can be used.
static bool is_sound(const struct companion *c)
{
    double length = 0;
    for (int k = 0; k < 3; k++) length += c->shake[k] * c->shake[k];
    return c->fps > 0 && c->from >= 0 && isfinite(c->fps) && isfinite(c->from) && fabs(length - 1) < 1e-3;
}

static bool parse(const char *path, const char *text, size_t size, struct companion *c, struct error *error)
{
    json_error_t wrong;
    const char *pin = "";
    int world = 0;
    json_t *object = json_read(text, size, 0, &wrong);
    bool done =
        object && json_unpack_ex(object, &wrong, 0, "{si si sF s[FFF] sF ss sb}", "frames", &c->frames, "vertices",
                                 &c->vertices, "fps", &c->fps, "shake", &c->shake[0], &c->shake[1], &c->shake[2],
                                 "from", &c->from, "pin", &pin, "world", &world) == 0;
    if (!done)
        fail(error, ERROR_INPUT, "%s: expected what wiggly simulate writes: %s", path, wrong.text);
    else if (!is_sound(c) || strlen(pin) >= sizeof c->pin)
        done = fail(error, ERROR_INPUT, "%s: expected what wiggly simulate writes, got a number out of range", path);
    else
        strcpy(c->pin, pin);
    c->world = world;
    json_decref(object);
    return done;
}

bool companion_read(const char *motion, int frames, int vertices, struct companion *c, struct error *error)
{
    char path[COMPANION_PATH], *text;
    size_t size;
    *c = (struct companion){0};
    if (!companion_path(motion, ".simulation.json", path) || access(path, F_OK) != 0) return true;
    if (!file_read_text(path, FILE_LIMIT, &text, &size, error)) return false;
    const bool done = parse(path, text, size, c, error);
    free(text);
    if (done && (c->frames != frames || c->vertices != vertices)) {
        print_line(stderr, "%s: warning: ignored, as it describes another motion (%d frames of %d vertices)", path,
                   c->frames, c->vertices);
        *c = (struct companion){0};
    }
    return done;
}
