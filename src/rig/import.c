/// Makes scenes for glTF characters.
#include "rig/import.h"
#include "base/file.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/character.h"
#include "rig/posing.h"
#include "scene/edit.h"
#include "scene/pins.h"
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { STANDARD_FRAMES = 120, LEAST_FRAMES = 2 };

static const double SLOWEST_RATE = 0.01; ///< frames a second of the longest clips
static const double NEAR = 0.01;         ///< frames between a key and the frame that it counts for
static const double SMALLEST = 0.3, LARGEST = 4, USUAL = 1.6; ///< metres: characters between these keep their size

/// Whether a file begins like a .glb, whatever its name.
static bool is_glb(const char *path)
{
    char start[4] = "";
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); // a FIFO would wait for a writer
    if (file < 0) return false;
    const bool is_read = read(file, start, sizeof start) == sizeof start;
    close(file);
    return is_read && memcmp(start, "glTF", sizeof start) == 0;
}

bool import_suits(const char *path)
{
    return path_has_end(path, ".glb") || path_has_end(path, ".gltf") || path_has_end(path, ".fbx") || is_glb(path);
}

/// How far a time may be from its frame, in frames: keys have single precision.
static double near_frame(double time, double fps) { return NEAR + 1.2e-7 * fabs(time) * fps; }

/// Number of a clip's keys that are whole frames after its first.
static int keys_on_frames(const struct gltf_clip *clip, double fps)
{
    int count = 0;
    for (int c = 0; c < clip->channel_count; c++) {
        for (int k = 0; k < clip->channels[c].key_count; k++) {
            const double time = (double)clip->channels[c].times[k], frame = (time - clip->first) * fps;
            count += fabs(frame - round(frame)) < near_frame(time, fps);
        }
    }
    return count;
}

/// The first of some usual rates, and the one of its densest channel, that has most of a clip's keys on frames.
static double frame_rate(const struct gltf_clip *clip)
{
    static const double usual[] = {24, 30, 25,  60,  50,  48, 24000 / 1001.0, 30000 / 1001.0, 60000 / 1001.0,
                                   72, 90, 100, 120, 144, 240};
    enum { USUAL_RATES = sizeof usual / sizeof usual[0] };
    double best = usual[0];
    int most = 0, keys = 0;
    if (!(clip && clip->last > clip->first)) return best;
    for (int c = 0; c < clip->channel_count; c++)
        if (clip->channels[c].key_count > keys) keys = clip->channels[c].key_count;
    const double own = (keys - 1) / (clip->last - clip->first), many = own * fmax(1, ceil(usual[0] / own));
    const double whole = fabs(many - round(many)) < 1e-5 * many ? round(many) : many;
    for (int r = 0; r <= USUAL_RATES; r++) {
        const double rate = r < USUAL_RATES ? usual[r] : whole;
        const int count = rate <= SCENE_MAX_FPS ? keys_on_frames(clip, rate) : 0;
        if (count <= most) continue;
        most = count;
        best = rate;
    }
    return best;
}

/// The scale, to one digit, that gives a tiny or huge character the usual size; else 1.
static double scale_of(const struct gltf *gltf)
{
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, (double)(gltf->hi[k] - gltf->lo[k]));
    if (!(size > 0) || (size >= SMALLEST && size <= LARGEST)) return 1;
    const double scale = USUAL / size, digit = maths_power_of_ten(maths_decade(scale));
    return round(scale / digit) * digit;
}

/// Gives a document the frame rate and the range of a clip, from its first key or just before it to its last or just after; of one that loops,
/// its length in whole frames. The rate is halved where a scene could not hold as many frames. NULL: there is no clip.
static bool set_range(struct document *document, const struct model_rig *model, const struct gltf_clip *clip,
                      struct error *error)
{
    const double most = (double)((SPLINE_MAX_SAMPLES - 1) / document->substeps - 1);
    double fps = frame_rate(clip), first = 0, frames = STANDARD_FRAMES;
    if (clip && clip->last > clip->first) {
        const struct clip_play play = clip_play(model, clip);
        while (play.length * fps > most && fps > SLOWEST_RATE) fps /= 2;
        frames = fmin(fmax(round(play.length * fps), LEAST_FRAMES), most);
        const bool is_whole = fabs(frames - play.length * fps) < near_frame(clip->last, fps);
        if (play.loops && !is_whole && frames / play.length <= SCENE_MAX_FPS) fps = frames / play.length;
        first = floor(clip->first * fps + near_frame(clip->first, fps));
        if (!play.loops)
            frames = fmax(fmin(ceil(clip->last * fps - near_frame(clip->last, fps)) - first, most), LEAST_FRAMES);
        first = fmin(fmax(first, -SCENE_MAX_FRAME), SCENE_MAX_FRAME - frames);
    }
    return edit_fps(document, fps, false, error) &&
           edit_range(document, (int)first, (int)(first + frames), RANGE_TRIM, error);
}

static bool follows_clip(const struct spline *spline) { return spline->parameter[PARAMETER_EQUILIBRIUM].motion; }

/// Gives a document a clip's range. Splines that follow the clip loop if it does.
static bool fit_to_clip(struct document *document, int rig, const struct gltf_clip *clip, struct error *error)
{
    if (!set_range(document, &document->rigs[rig]->model, clip, error)) return false;
    const struct clip_play play = clip_play(&document->rigs[rig]->model, clip);
    const struct param start = param_number(posing_clip_loops(document, &play) ? WIGGLY_LOOP : WIGGLY_REST);
    for (int s = 0; s < document->spline_count; s++) {
        if (!follows_clip(document->splines[s])) continue;
        if (!edit_parameter(document, s, PARAMETER_START, &start, error)) return false;
    }
    return true;
}

/// A coordinate's spline: the given one, or a new one with the coordinate's frequency and damping and a knot at frame 0.
static int spline_for(struct document *document, int spline, const struct coordinate *coordinate, struct error *error)
{
    const struct {
        enum parameter parameter;
        double value;
    } swing[] = {{PARAMETER_FREQUENCY, round(coordinate->frequency * 100) / 100},
                 {PARAMETER_DAMPING, round(coordinate->damping * 1000) / 1000}};
    if (spline >= 0) return spline;
    const int added = document->spline_count;
    const struct knot first = {.frame = document->first_frame, .value = 0.5}; // so that it swings at once
    if (!edit_spline_add(document, -1, NULL, &first, error)) return -1;
    for (size_t i = 0; i < sizeof swing / sizeof swing[0]; i++) {
        const struct param value = param_number(swing[i].value);
        if (swing[i].value > 0 && !edit_parameter(document, added, swing[i].parameter, &value, error)) return -1;
    }
    return added;
}

/// A soft character, its first coordinate driven.
static bool add_soft(struct document *document, char *file, int spline, const struct character *character,
                     struct error *error)
{
    const struct coordinate *first = &character->coordinates[0];
    const int driver = spline_for(document, spline, first, error);
    struct drive drive = {.name = first->name, .spline = driver, .amplitude = DRIVE_DEFAULT_AMPLITUDE};
    const struct rig rig = {.kind = RIG_CHARACTER,
                            .character = {.model = file, .phases = -1, .drives = &drive, .drive_count = 1}};
    return driver >= 0 && edit_rig_add(document, &rig, error);
}

/// A stiff character, or one with bones. An empty document takes the clip's frame rate and range.
static bool add_imported(struct document *document, char *file, const struct gltf *gltf, struct error *error)
{
    const struct gltf_clip *clip = gltf->clip_count > 0 ? &gltf->clips[0] : NULL;
    const struct rig rig = {.kind = RIG_MODEL,
                            .model = {.model = file, .clip = clip ? clip->name : NULL, .scale = scale_of(gltf)}};
    if (document->spline_count == 0 && document->rig_count == 0) {
        if (!set_range(document, &rig.model, clip, error)) return false;
    }
    return edit_rig_add(document, &rig, error);
}

bool import_add(struct document *document, const char *path, int spline, struct error *error)
{
    char file[PATH_LIMIT];
    struct character character = {0};
    struct gltf gltf = {0};
    if (!path_rebase(path, NULL, document->folder, file)) snprintf(file, sizeof file, "%s", path);
    if (!gltf_read(path, &gltf, error)) return false;
    const bool is_soft = gltf_is_soft(&gltf);
    const bool added =
        is_soft ? character_read(path, &character, error) && add_soft(document, file, spline, &character, error)
                : add_imported(document, file, &gltf, error);
    character_free(&character);
    gltf_free(&gltf);
    return added;
}

struct document *import_scene(const char *path, struct error *error)
{
    char folder[PATH_LIMIT];
    struct document *document = document_create();
    if (path_folder(path, folder) && folder[0]) document->folder = need_text(folder);
    if (import_add(document, path, -1, error)) return document;
    document_destroy(document);
    return NULL;
}

static bool set_clip(struct document *document, int rig, const char *clip, enum clip_repeat repeat,
                     struct error *error)
{
    struct rig changed = *document->rigs[rig];
    char *name = changed.model.clip = clip && clip[0] ? need_text(clip) : NULL;
    changed.model.repeat = (int)repeat;
    const bool done = edit_rig_set(document, rig, &changed, error);
    free(name);
    return done;
}

/// Whether nothing in the scene belongs to a frame: there are no knots or pins, and no splines or some that follow the clip.
static bool is_of_clip(const struct document *document)
{
    bool follows = document->spline_count == 0;
    for (int s = 0; s < document->spline_count; s++) {
        if (document->splines[s]->knot_count > 0) return false;
        follows = follows || follows_clip(document->splines[s]);
    }
    return follows && pins_count(document) == 0;
}

bool import_choose_clip(struct document *document, int rig, const struct gltf *gltf, const char *clip,
                        enum clip_repeat repeat, struct error *error)
{
    const int found = gltf_find_clip(gltf, clip);
    if (!set_clip(document, rig, clip, repeat, error)) return false;
    return found < 0 || !is_of_clip(document) || fit_to_clip(document, rig, &gltf->clips[found], error);
}

/// Removes knots and pins that were set for another clip.
static bool remove_keys(struct document *document, struct error *error)
{
    for (int s = 0; s < document->spline_count; s++) {
        while (follows_clip(document->splines[s]) && document->splines[s]->knot_count > 0)
            if (!edit_knot_remove(document, s, document->splines[s]->knots[0].id, error)) return false;
    }
    for (int r = 0; r < document->rig_count; r++) {
        while (document->rigs[r]->kind == RIG_CHAIN && document->rigs[r]->pin_count > 0)
            if (!edit_pin_remove(document, r, document->rigs[r]->pins[0].id, error)) return false;
    }
    return true;
}

struct document *import_with_clip(const struct document *document, int rig, const struct gltf *gltf, int clip,
                                  struct error *error)
{
    struct document *copy = document_copy(document);
    if (remove_keys(copy, error) && set_clip(copy, rig, gltf->clips[clip].name, REPEAT_BY_CLIP, error) &&
        fit_to_clip(copy, rig, &gltf->clips[clip], error))
        return copy;
    document_destroy(copy);
    return NULL;
}
