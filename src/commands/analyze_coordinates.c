/// Writes the table for `wiggly analyze --coordinates`.
#include "base/error.h"
#include "base/file.h"
#include "commands/analyze_scene.h"

static void write_header(FILE *out, const struct character *character)
{
    static const char *const suffixes[] = {".re", ".im", ".fit.re", ".fit.im"};
    fputs("frame", out);
    for (int i = 0; i < character->coordinate_count; i++) {
        for (int k = 0; k < 4; k++) {
            fputc(',', out);
            print_field(out, character->coordinates[i].name, suffixes[k]);
        }
    }
    fputc('\n', out);
}

/// A motion that has ended leaves its fields empty.
static void write_row(FILE *out, const struct analyzed *analyzed, int count, int frame)
{
    fprintf(out, "%d", frame);
    for (int i = 0; i < count; i++) {
        if (frame >= analyzed[i].frames) {
            fputs(",,,,", out);
            continue;
        }
        double complex r = analyzed[i].series[frame], x = analyzed[i].knots.series[frame];
        fprintf(out, ",%.9g,%.9g,%.9g,%.9g", creal(r), cimag(r), creal(x), cimag(x));
    }
    fputc('\n', out);
}

bool analyze_coordinates_write(const char *path, const struct character *character, const struct analyzed *analyzed,
                               struct error *error)
{
    struct file_output output;
    int frames = 0;
    for (int i = 0; i < character->coordinate_count; i++) {
        if (analyzed[i].frames > frames) frames = analyzed[i].frames;
    }
    if (!file_output_open(&output, path, error)) return false;
    write_header(output.stream, character);
    for (int t = 0; t < frames && !ferror(output.stream); t++)
        write_row(output.stream, analyzed, character->coordinate_count, t);
    return file_output_commit(&output, error);
}
