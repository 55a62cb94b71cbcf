/// Finds the format, the rigs and the keys, poses the rigs at these, and writes the file, and those that it names, whole or not at all.
#include "base/need.h"
#include "export/form.h"
#include "scene/text.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum {
    MORPHS = CHOICE_KEYS | CHOICE_RIG | CHOICE_CLIP | CHOICE_SIGNED,
    POINTS = CHOICE_KEYS | CHOICE_RIG | CHOICE_ONE,
    MODEL = FORM_MESH | FORM_FILE
};

// In the order of the Export dialog.
const struct export_format export_formats[EXPORT_FORMATS] = {
    {".glb", "character and motion: Blender, three.js, game engines", false, MORPHS | CHOICE_CLIPS, MODEL,
     .write = gltf_write, .is_binary = true},
    {".gltf", "the same as readable text", true, MORPHS | CHOICE_CLIPS, MODEL, .write = gltf_write},
    {".usda", "character and motion: USD, Houdini, Omniverse", false, MORPHS & ~CHOICE_CLIP, MODEL,
     .write = usda_write},
    {".bvh", "joints and their motion: motion-capture tools", false, POINTS | CHOICE_JOINTS, FORM_JOINTS,
     .write = bvh_write},
    {".csv", "every spline and angle as a table", false, CHOICE_KEYS | CHOICE_RIG, .write = csv_write},
    {".pc2", "every vertex at every key: Blender's Mesh Cache", true, POINTS, FORM_POINTS, .write = points_write,
     .motion = MOTION_PC2},
    {".mdd", "the same for Maya, LightWave and others", true, POINTS, FORM_POINTS, .write = points_write,
     .motion = MOTION_MDD},
    {".npy", "the same as an array: Python", true, POINTS, FORM_POINTS, .write = points_write, .motion = MOTION_NPY},
    {".gif", "a small film that repeats: messages, README files", false, CHOICE_SIZE, .film = FILM_GIF, .width = 640,
     .height = 360, .most_rate = 50, .repeats = true},
    {".mp4", "a film that plays everywhere", false, CHOICE_SIZE, .film = FILM_MP4, .width = 1280, .height = 720,
     .most_rate = INFINITY, .is_even = true},
    {".webm", "a film for web pages", true, CHOICE_SIZE | CHOICE_ALPHA, .film = FILM_WEBM, .width = 1280,
     .height = 720, .most_rate = INFINITY, .is_even = true},
    {".png", "one numbered picture per frame", true, CHOICE_SIZE | CHOICE_ALPHA, .film = FILM_PNG, .width = 1280,
     .height = 720, .most_rate = INFINITY},
};

enum { MAX_KEYS = 100000000, NAMES_TEXT = 256, NAME_MOST = 64 };

const struct export_format *export_format(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < EXPORT_FORMATS; i++) {
        if (strcasecmp(dot, export_formats[i].ending) == 0) return &export_formats[i];
    }
    return NULL;
}

bool export_loops(const struct document *document)
{
    return document_loops(document) || document_find_rig(document, RIG_MODEL, 0) >= 0;
}

double export_pictures(const struct export_format *format, const struct document *document, double frames, int loops,
                       double *rate)
{
    if (!(*rate > 0)) *rate = fmin(document->fps, format->most_rate);
    const double steps = frames / (document->fps / *rate);
    const int rounds = loops > 0 ? loops : format->repeats && export_loops(document);
    return rounds > 0 && steps > 0 ? fmax(1, round(rounds * steps))
                                   : floor(steps + 1e-6) + 1; // a loop's end is its start
}

static bool fits(const struct export_format *format, unsigned holds)
{
    return !holds || (!format->film && (!format->holds || (format->holds & holds)));
}

void export_endings(unsigned holds, char text[EXPORT_ENDINGS])
{
    int left = 0;
    for (int i = 0; i < EXPORT_FORMATS; i++) left += fits(&export_formats[i], holds);
    text[0] = '\0';
    for (int i = 0; i < EXPORT_FORMATS; i++) {
        if (!fits(&export_formats[i], holds)) continue;
        strcat(text, export_formats[i].ending);
        left--;
        strcat(text, left > 1 ? ", " : left == 1 ? " or " : "");
    }
}

static bool choose_rigs(struct export_range *range, struct error *error)
{
    const struct document *document = range->posing->document;
    const struct export_format *format = range->format;
    const char *wanted = range->options->rig;
    int unfit = -1;
    for (int i = 0; i < document->rig_count && i < SCENE_MAX_RIGS; i++) {
        const struct rig *rig = document->rigs[i];
        if (wanted && strcmp(form_name(rig), wanted) != 0) continue;
        if (fits(format, form_kind(range->posing, i)->holds)) {
            range->rigs[range->rig_count++] = i;
        } else if (unfit < 0) {
            unfit = i;
        }
    }
    const bool none = range->rig_count == 0 && (format->holds || wanted);
    if (!none && (range->rig_count <= 1 || !(format->choices & CHOICE_ONE))) return true;

    char names[NAMES_TEXT], endings[EXPORT_ENDINGS];
    size_t used = 0;
    names[0] = '\0';
    for (int i = 0; i < document->rig_count && used + NAME_MOST + 8 < NAMES_TEXT; i++) { // as far as there is room
        const char *name = form_name(document->rigs[i]);
        used += (size_t)sprintf(names + used, "%s\"%.*s\"", i > 0 ? ", " : "", name_fit(name, NAME_MOST), name);
    }
    if (none && document->rig_count == 0)
        return fail(error, ERROR_INPUT, "the scene has no rig to export: its splines go into a .csv file");
    if (none && unfit < 0)
        return fail(error, ERROR_INPUT, "%s: expected the name of a rig, %s, got \"%s\"", range->rig_choice, names,
                    wanted);
    if (none) {
        const struct rig *rig = document->rigs[unfit];
        export_endings(form_kind(range->posing, unfit)->holds, endings);
        return fail(error, ERROR_INPUT, "a %s file cannot hold the %s \"%s\": export it as %s", format->ending,
                    rig_word(rig->kind), form_name(rig), endings);
    }
    return fail(error, ERROR_INPUT, "a %s file holds one rig: choose one of %s with %s", format->ending, names,
                range->rig_choice);
}

bool range_choose_keys(struct export_range *range, struct export_report *report, struct error *error)
{
    const struct export_options *options = range->options;
    const struct document *document = range->posing->document;
    const double first = options->has_frames ? options->first : document->first_frame;
    const double last = options->has_frames ? options->last : document->last_frame;
    const int substeps = options->substeps > 0 ? options->substeps : document->substeps;
    if (!(first <= last) || first < document->first_frame || last > document->last_frame)
        return fail(error, ERROR_INPUT, "--frames: expected frames from %d to %d in this order, got %g:%g",
                    document->first_frame, document->last_frame, first, last);
    range->first = first;
    range->spacing = options->rate > 0 ? document->fps / options->rate : 1.0 / substeps;
    const double keys = floor((last - first) / range->spacing + 1e-6) + 1;
    if (keys > MAX_KEYS)
        return fail(error, ERROR_INPUT, "expected at most %d keys, got %.0f: choose fewer frames or keys per second",
                    MAX_KEYS, keys);
    range->key_count = (int)keys;
    range->total += (long)range->key_count * range->rig_count;
    const double end = range_frame(range, range->key_count - 1);
    if (fabs(end - last) > 1e-6)
        snprintf(report->note, sizeof report->note, "the last key is on frame %g, because no key falls on frame %g",
                 end, last);
    return true;
}

// --- the files beside the one that is written

bool sidecars_add(struct sidecars *sidecars, const char *folder, const char *name, const void *data, size_t size,
                  struct error *error)
{
    if (!sidecars->folder[0]) {
        snprintf(sidecars->folder, sizeof sidecars->folder, "%s", folder);
        sidecars->is_new = mkdir(folder, 0777) == 0;
        if (!sidecars->is_new && errno != EEXIST)
            return fail(error, ERROR_ENVIRONMENT, "%s: cannot be made: %s", folder, strerror(errno));
    }
    sidecars->files = need_more(sidecars->files, (size_t)sidecars->count + 1, sizeof *sidecars->files);
    struct sidecar *file = &sidecars->files[sidecars->count];
    file->path = pool_text(&sidecars->paths, folder, "/", name);
    file->is_new = access(file->path, F_OK) != 0;
    if (!file_check_place(file->path, error) || !file_output_open(&file->output, file->path, error)) return false;
    sidecars->count++;
    fwrite(data, 1, size, file->output.stream); // whether it could be written is seen as it is committed
    return true;
}

bool sidecars_commit(struct sidecars *sidecars, struct error *error)
{
    for (int i = 0; i < sidecars->count; i++) {
        if (!file_output_commit(&sidecars->files[i].output, error)) return false;
    }
    return true;
}

/// Keeps committed files.
static void sidecars_free(struct sidecars *sidecars)
{
    free(sidecars->files);
    pool_free(&sidecars->paths);
    *sidecars = (struct sidecars){0};
}

void sidecars_discard(struct sidecars *sidecars)
{
    for (int i = 0; i < sidecars->count; i++) {
        const bool committed = !sidecars->files[i].output.stream;
        if (!committed) file_output_discard(&sidecars->files[i].output);
        if (committed && sidecars->files[i].is_new) unlink(sidecars->files[i].path);
    }
    if (sidecars->is_new) rmdir(sidecars->folder);
    sidecars_free(sidecars);
}

bool export_write(const struct posing *posing, const char *path, const struct export_options *options,
                  struct export_report *report, struct error *error)
{
    char endings[EXPORT_ENDINGS];
    struct export_range range = {
        .posing = posing,
        .options = options,
        .format = export_format(path),
        .path = path,
        .rig_choice = options->rig_choice ? options->rig_choice : "--rig",
    };
    *report = (struct export_report){0};
    if (!range.format || range.format->film) {
        export_endings(~0u, endings);
        return fail(error, ERROR_USAGE, "%s: expected a name ending in %s", path, endings);
    }
    if (options->all_clips && !(range.format->choices & CHOICE_CLIPS))
        return fail(error, ERROR_USAGE, "%s: holds one clip: all clips need .glb or .gltf", path);
    const char *file = posing->document->path ? path_name(posing->document->path) : "wiggly";
    const char *dot = strrchr(file, '.');
    range.title = name_from(file, dot ? (size_t)(dot - file) : strlen(file)); // the scene's own name
    struct file_output output;
    struct sidecars *sidecars = &range.sidecars;
    bool done = choose_rigs(&range, error) && range_choose_keys(&range, report, error) &&
                file_check_place(path, error) && file_output_open(&output, path, error);
    if (done) {
        // The files that this one names come first; a full disk is seen before that.
        done = range.format->write(&range, output.stream, error);
        const double bytes = (double)ftello(output.stream);
        const bool broken = fflush(output.stream) != 0 || ferror(output.stream);
        done = done && (broken || sidecars_commit(sidecars, error));
        if (!done) file_output_discard(&output);
        done = done && file_output_commit(&output, error);
        snprintf(report->text, sizeof report->text,
                 bytes < 1e3   ? "%s, %.0f bytes"
                 : bytes < 1e6 ? "%s, %.0f KB"
                               : "%s, %.1f MB",
                 range.summary,
                 bytes < 1e3   ? bytes
                 : bytes < 1e6 ? bytes / 1e3
                               : bytes / 1e6);
    }
    if (done)
        sidecars_free(sidecars);
    else
        sidecars_discard(sidecars);
    free(range.title);
    return done;
}

// --- the rigs at the times that are exported

double range_frame(const struct export_range *range, int key)
{
    return range->frames ? range->frames[key] : range->first + key * range->spacing;
}

double range_seconds(const struct export_range *range, int key)
{
    return key * range->spacing / range->posing->document->fps;
}

/// In samples. A key that is meant to fall on a sample must not miss it by rounding: the last of a loop is the first.
double range_position(const struct export_range *range, int key)
{
    const struct document *document = range->posing->document;
    const double position = (range_frame(range, key) - document->first_frame) * document->substeps;
    return fabs(position - round(position)) < 1e-6 ? round(position) : position;
}

bool range_pose(const struct export_range *range, int rig, int key, struct rig_pose *pose, struct error *error)
{
    const int body = rig_body(range->posing->document, rig);
    if (rig_pose_body(range->posing, body, range_position(range, key), pose)) return true;
    return fail(error, ERROR_INPUT, "rigs[%d]: its model could not be read", rig);
}

const float *range_root(const struct export_range *range, int rig, const struct rig_pose *pose)
{
    const bool is_placed =
        range->options->as_shown || (range->rig_count > 1 && !(range->format->choices & CHOICE_ONE));
    return is_placed && form_kind(range->posing, rig) == &model_form ? pose->model.root : NULL;
}

bool range_proceed(struct export_range *range, struct error *error)
{
    range->done++;
    const struct export_options *options = range->options;
    if (!options->proceed || options->proceed(options->user, range->done, range->total)) return true;
    return fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
}
