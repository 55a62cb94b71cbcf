/// Writes the scene and the table of coordinates for `wiggly analyze`.
#include "commands/analyze_scene.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
#include "scene/edit.h"
#include "scene/load.h"
#include <math.h>
#include <stdlib.h>

static bool add_knots(struct document *document, int spline, const struct analyzed *analyzed, struct error *error)
{
    const struct knots *knots = &analyzed->knots;
    for (int i = 0; i < knots->count; i++) {
        const double frame = knots->frame[i] * document->fps / analyzed->fps;
        const struct knot knot = {.frame = round(frame * 1000) / 1000,
                                  .value = knots->value[i],
                                  .slope = knots->sloped ? knots->slope[i] : 0,
                                  .has_slope = knots->sloped,
                                  .stiffness = KNOT_DEFAULT_STIFFNESS};
        if (!edit_knot_insert(document, spline, &knot, error)) return false;
    }
    return true;
}

static bool add_spline(struct document *document, const char *name, const struct analyzed *analyzed,
                       struct error *error)
{
    const struct knots *knots = &analyzed->knots;
    const struct {
        enum parameter parameter;
        double value;
    } set[] = {{PARAMETER_MODE, knots->mode},
               {PARAMETER_FREQUENCY, knots->frequency},
               {PARAMETER_DAMPING, knots->damping},
               {PARAMETER_WIND_UP, 0}, // the fit is to the whole curve
               {PARAMETER_BANDWIDTH, knots->bandwidth}};
    const int spline = document->spline_count, count = knots->mode == WIGGLY_COMPLEX ? 5 : 4;
    if (!edit_spline_add(document, -1, name, NULL, error)) return false;
    for (int i = 0; i < count; i++) {
        const struct param value = param_number(set[i].value);
        if (!edit_parameter(document, spline, set[i].parameter, &value, error)) return false;
    }
    return add_knots(document, spline, analyzed, error);
}

/// Chooses the coordinates the scene drives; returns how many.
static int choose(const struct character *character, const struct analyzed *analyzed, int *chosen)
{
    int count = 0;
    for (int rank = 0; rank < character->coordinate_count; rank++) {
        for (int i = 0; i < character->coordinate_count && count < CHARACTER_MAX_DRIVES; i++) {
            if (analyzed[i].rank == rank) chosen[count++] = i;
        }
    }
    return count;
}

static bool fill(struct document *document, const char *model, const struct character *character,
                 const struct analyzed *analyzed, struct error *error)
{
    int chosen[CHARACTER_MAX_DRIVES], count = choose(character, analyzed, chosen);
    struct drive drives[CHARACTER_MAX_DRIVES];
    char name[] = "character", *file = need_text(path_name(model));
    struct rig rig = {
        .kind = RIG_CHARACTER, .name = name, .character = {.model = file, .phases = -1, .drives = drives}};
    double fps = 0, seconds = 0;
    for (int i = 0; i < count; i++) {
        const struct analyzed *each = &analyzed[chosen[i]];
        fps = fmax(fps, each->fps);
        seconds = fmax(seconds, (each->frames - 1) / each->fps);
    }
    bool done = edit_fps(document, fps, false, error) &&
                edit_range(document, 0, (int)round(fps * seconds), RANGE_REFUSE, error);
    for (int i = 0; done && i < count; i++) {
        char *driver = character->coordinates[chosen[i]].name;
        drives[rig.character.drive_count++] = (struct drive){.name = driver, .spline = i, .amplitude = 1};
        done = add_spline(document, driver, &analyzed[chosen[i]], error);
    }
    done = done && edit_rig_add(document, &rig, error);
    free(file);
    return done;
}

bool analyze_scene_write(const char *path, const char *model, const struct character *character,
                         const struct analyzed *analyzed, struct error *error)
{
    char folder[PATH_LIMIT];
    struct document *document = document_create();
    if (path_folder(model, folder) && folder[0]) document->folder = need_text(folder);
    const bool done = fill(document, model, character, analyzed, error) && scene_save(document, path, error);
    document_destroy(document);
    return done;
}

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

/// Fields stay empty after a motion's end.
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
