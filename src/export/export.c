/// Finds the format, the rigs and the keys, and writes the file whole or not at all.
#include "export/export.h"
#include "base/file.h"
#include "export/format.h"
#include "scene/number.h"
#include <math.h>
#include <string.h>
#include <strings.h>
#include <sys/types.h>

static const struct format formats[] = {
    {.ending = ".glb", .write = glb_write},
    {.ending = ".gltf", .write = gltf_write},
    {.ending = ".usda", .write = usda_write},
    {.ending = ".bvh", .write = bvh_write, .needs_joints = true, .one_rig = true},
    {.ending = ".csv", .write = csv_write, .without_rigs = true},
    {.ending = ".pc2", .write = pc2_write, .one_rig = true},
    {.ending = ".mdd", .write = mdd_write, .one_rig = true},
    {.ending = ".npy", .write = npy_write, .one_rig = true},
};

enum { FORMAT_COUNT = sizeof formats / sizeof *formats, MAX_KEYS = 100000000 };

static const struct format *find_format(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && i < FORMAT_COUNT; i++) {
        if (strcasecmp(dot, formats[i].ending) == 0) return &formats[i];
    }
    return NULL;
}

/// The endings of all formats or of those that hold more than joints.
static void list_endings(bool with_meshes, char text[EXPORT_ENDINGS])
{
    int left = 0;
    for (int i = 0; i < FORMAT_COUNT; i++) left += !with_meshes || !formats[i].needs_joints;
    text[0] = '\0';
    for (int i = 0; i < FORMAT_COUNT; i++) {
        if (with_meshes && formats[i].needs_joints) continue;
        strcat(text, formats[i].ending);
        left--;
        strcat(text, left > 1 ? ", " : left == 1 ? (with_meshes ? " or " : " and ") : "");
    }
}

bool export_knows(const char *path) { return find_format(path) != NULL; }

void export_endings(char text[EXPORT_ENDINGS]) { list_endings(false, text); }

/// The names of all rigs, as far as there is room.
static void list_names(const struct document *document, char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < document->rig_count && used < size; i++)
        used +=
            (size_t)snprintf(text + used, size - used, "%s\"%s\"", i > 0 ? ", " : "", form_name(&document->rigs[i]));
}

static bool fits(const struct format *format, const struct rig *rig)
{
    const struct form_kind *kind = form_kind(rig->kind);
    return kind && (kind->has_joints || !format->needs_joints);
}

/// Why there is no rig to write.
static bool fail_rigs(const struct take *take, const struct format *format, const char *wanted, bool found,
                      struct error *error)
{
    const struct document *document = take->posing->document;
    char names[256], endings[EXPORT_ENDINGS];
    list_names(document, names, sizeof names);
    list_endings(true, endings);
    if (document->rig_count == 0)
        return fail(error, ERROR_INPUT, "the scene has no rig to export: its splines go into a .csv file");
    if (wanted && !found)
        return fail(error, ERROR_INPUT, "--rig: expected the name of a rig, %s, got \"%s\"", names, wanted);
    if (wanted) snprintf(names, sizeof names, "\"%s\"", wanted);
    return fail(error, ERROR_INPUT, "a %s file holds joints, and %s has none: export it as %s", format->ending, names,
                endings);
}

static bool choose_rigs(struct take *take, const struct format *format, const char *wanted, struct error *error)
{
    const struct document *document = take->posing->document;
    bool found = false;
    for (int i = 0; i < document->rig_count && i < SCENE_MAX_RIGS; i++) {
        if (wanted && strcmp(form_name(&document->rigs[i]), wanted) != 0) continue;
        found = true;
        if (fits(format, &document->rigs[i])) take->rigs[take->rig_count++] = i;
    }
    if (take->rig_count == 0 && !(format->without_rigs && !wanted))
        return fail_rigs(take, format, wanted, found, error);
    if (take->rig_count <= 1 || !format->one_rig) return true;
    char names[256];
    list_names(document, names, sizeof names);
    return fail(error, ERROR_INPUT, "a %s file holds one rig: choose one of %s with --rig", format->ending, names);
}

static bool choose_keys(struct take *take, const struct export_options *options, struct export_report *report,
                        struct error *error)
{
    const struct document *document = take->posing->document;
    const double first = options->has_frames ? options->first : document->first_frame;
    const double last = options->has_frames ? options->last : document->last_frame;
    const int substeps = options->substeps > 0 ? options->substeps : document->substeps;
    if (!(first <= last) || first < document->first_frame || last > document->last_frame)
        return fail(error, ERROR_INPUT, "--frames: expected frames from %d to %d in this order, got %g:%g",
                    document->first_frame, document->last_frame, first, last);
    take->first = first;
    take->spacing = options->rate > 0 ? document->fps / options->rate : 1.0 / substeps;
    const double keys = floor((last - first) / take->spacing + 1e-6) + 1;
    if (keys > MAX_KEYS)
        return fail(error, ERROR_INPUT, "expected at most %d keys, got %.0f: ask for fewer frames or keys a second",
                    MAX_KEYS, keys);
    take->key_count = (int)keys;
    const double end = take_frame(take, take->key_count - 1);
    if (fabs(end - last) > 1e-6)
        snprintf(report->note, sizeof report->note, "the last key is on frame %g, because no key falls on frame %g",
                 end, last);
    return true;
}

/// The scene's own name, or "wiggly".
static void name_clip(struct take *take, const char *wanted, char name[FORM_NAME])
{
    const char *path = take->posing->document->path;
    const char *slash = path ? strrchr(path, '/') : NULL;
    const char *file = slash ? slash + 1 : path;
    const char *dot = file ? strrchr(file, '.') : NULL;
    if (wanted) {
        take->clip = wanted;
        return;
    }
    snprintf(name, FORM_NAME, "%.*s", dot ? (int)(dot - file) : 60, file ? file : "wiggly");
    take->clip = name;
}

/// "47 KB"
static void print_size(off_t bytes, char *text, size_t size)
{
    if (bytes < 1000) {
        snprintf(text, size, "%d bytes", (int)bytes);
    } else if (bytes < 1000000) {
        snprintf(text, size, "%.0f KB", (double)bytes / 1e3);
    } else {
        snprintf(text, size, "%.1f MB", (double)bytes / 1e6);
    }
}

static bool write_file(struct take *take, const struct format *format, const char *path, struct export_report *report,
                       struct error *error)
{
    struct file_output output;
    char summary[FORMAT_SUMMARY] = "", size[32];
    if (!file_output_open(&output, path, error)) return false;
    if (!format->write(take, output.stream, summary, error)) {
        file_output_discard(&output);
        return false;
    }
    const off_t bytes = ftello(output.stream); // −1 for a pipe
    if (!file_output_commit(&output, error)) return false;
    print_size(bytes, size, sizeof size);
    snprintf(report->text, sizeof report->text, "%s%s%s", summary, bytes >= 0 ? ", " : "", bytes >= 0 ? size : "");
    return true;
}

bool export_write(const struct posing *posing, const char *path, const struct export_options *options,
                  struct export_report *report, struct error *error)
{
    const struct format *format = find_format(path);
    char name[FORM_NAME], endings[EXPORT_ENDINGS];
    struct take take = {
        .posing = posing,
        .is_signed = options->is_signed,
        .is_cubic = options->is_cubic,
        .proceed = options->proceed,
        .user = options->user,
    };
    *report = (struct export_report){0};
    if (!format) {
        export_endings(endings);
        return fail(error, ERROR_USAGE, "%s: expected a name ending in %s", path, endings);
    }
    if (!choose_rigs(&take, format, options->rig, error) || !choose_keys(&take, options, report, error)) return false;
    name_clip(&take, options->clip, name);
    return write_file(&take, format, path, report, error);
}
