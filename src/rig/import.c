/// Makes scenes for glTF characters.
#include "rig/import.h"
#include "base/path.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STANDARD_FRAMES = 120, LEAST_FRAMES = 2, MOST_FRAMES = 100000 };

static const double SMALLEST = 0.3, LARGEST = 4, USUAL = 1.6; ///< metres: characters in between keep their size

bool import_suits(const char *path) { return path_has_end(path, ".glb") || path_has_end(path, ".gltf"); }

/// How many keys of a clip lie on whole frames.
static int keys_on_frames(const struct gltf_clip *clip, double fps)
{
    int count = 0;
    for (int c = 0; c < clip->channel_count; c++) {
        for (int k = 0; k < clip->channels[c].key_count; k++) {
            const double frame = (double)clip->channels[c].times[k] * fps;
            count += fabs(frame - round(frame)) < 0.01;
        }
    }
    return count;
}

static double frame_rate(const struct gltf_clip *clip)
{
    static const double rates[] = {24, 30, 25, 60, 50, 48};
    double best = rates[0];
    int most = clip ? keys_on_frames(clip, best) : 0;
    for (size_t r = 1; clip && r < sizeof rates / sizeof rates[0]; r++) {
        const int count = keys_on_frames(clip, rates[r]);
        if (count <= most) continue;
        most = count;
        best = rates[r];
    }
    return best;
}

/// 1, or what makes a tiny or huge character as tall as others, to one digit.
static double scale_of(const struct gltf *gltf)
{
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, (double)(gltf->hi[k] - gltf->lo[k]));
    if (!(size > 0) || (size >= SMALLEST && size <= LARGEST)) return 1;
    const double scale = USUAL / size, digit = pow(10, floor(log10(scale)));
    return round(scale / digit) * digit;
}

static int last_frame(const struct gltf_clip *clip, double fps)
{
    if (!clip || !(clip->duration > 0)) return STANDARD_FRAMES;
    return (int)fmin(fmax(round(clip->duration * fps), LEAST_FRAMES), MOST_FRAMES);
}

/// Adds the character to an empty document.
static bool add_character(struct document *document, const struct gltf *gltf, const char *path, struct error *error)
{
    const struct gltf_clip *clip = gltf->clip_count > 0 ? &gltf->clips[0] : NULL;
    const char *slash = strrchr(path, '/');
    char folder[PATH_LIMIT], file[PATH_LIMIT];
    struct history *history = history_create();
    snprintf(file, sizeof file, "%s", slash ? slash + 1 : path);
    struct rig rig = {.kind = RIG_MODEL,
                      .model = {.model = file, .clip = clip ? clip->name : NULL, .scale = scale_of(gltf)}};
    if (path_folder(path, folder) && folder[0]) document->folder = strdup(folder);
    document->fps = frame_rate(clip);
    document->last_frame = last_frame(clip, document->fps);
    if (!history) return fail_no_memory(error, path);
    history_begin(history, "Import", 0);
    bool added = history_apply(history, document, &(struct edit){.kind = EDIT_MODEL_ADD, .contents = &rig}, error);
    history_end(history);
    history_destroy(history);
    return added;
}

struct document *import_scene(const char *path, struct error *error)
{
    struct gltf gltf = {0};
    if (!gltf_read(path, &gltf, error)) return NULL;
    struct document *document = document_create();
    if (!document) fail_no_memory(error, path);
    if (document && !add_character(document, &gltf, path, error)) {
        document_destroy(document);
        document = NULL;
    }
    gltf_free(&gltf);
    return document;
}

bool import_choose_clip(struct history *history, struct document *document, int rig, const struct gltf *gltf,
                        const char *clip, struct error *error)
{
    const int found = clip ? gltf_find_clip(gltf, clip) : -1;
    const struct edit choice = {.kind = EDIT_CLIP, .rig = rig, .text = clip};
    if (!history_apply(history, document, &choice, error)) return false;
    if (found < 0 || document->spline_count > 0) return true;
    const double fps = frame_rate(&gltf->clips[found]);
    const struct edit rate = {.kind = EDIT_FPS, .number = fps};
    const struct edit range = {.kind = EDIT_RANGE, .first = 0, .last = last_frame(&gltf->clips[found], fps)};
    return history_apply(history, document, &rate, error) && history_apply(history, document, &range, error);
}
