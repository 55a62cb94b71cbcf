/// Makes scenes for glTF characters, and chains of their bones; opens and solves scenes for commands.
#include "rig/import.h"
#include "base/file.h"
#include "base/need.h"
#include "maths/maths.h"
#include "rig/strand.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "scene/pins.h"
#include <ctype.h>
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

bool import_suits(const char *path)
{
    if (path_has_end(path, ".glb") || path_has_end(path, ".gltf") || path_has_end(path, ".fbx")) return true;
    char start[4] = "";                                             // of a .glb, whatever its name
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC); // a FIFO would wait for a writer
    if (file < 0) return false;
    const bool is_read = read(file, start, sizeof start) == sizeof start;
    close(file);
    return is_read && memcmp(start, "glTF", sizeof start) == 0;
}

/// How far a time may be from its frame, in frames: keys have single precision.
static double near_frame(double time, double fps) { return NEAR + 1.2e-7 * fabs(time) * fps; }

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
        int count = 0; // keys that are whole frames after the clip's first
        for (int c = 0; c < clip->channel_count && rate <= SCENE_MAX_FPS; c++) {
            for (int k = 0; k < clip->channels[c].key_count; k++) {
                const double time = (double)clip->channels[c].times[k], frame = (time - clip->first) * rate;
                count += fabs(frame - round(frame)) < near_frame(time, rate);
            }
        }
        if (count <= most) continue;
        most = count;
        best = rate;
    }
    return best;
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

/// Appends a spline with a frequency and a damping ratio, where they are known.
static bool add_spline(struct document *document, const char *name, const struct knot *knot, double hertz,
                       double ratio, struct error *error)
{
    const struct param frequency = param_number(hertz), damping = param_number(ratio);
    const int spline = document->spline_count;
    return edit_spline_add(document, -1, name, knot, error) &&
           (!(hertz > 0) || edit_parameter(document, spline, PARAMETER_FREQUENCY, &frequency, error)) &&
           (!(ratio > 0) || edit_parameter(document, spline, PARAMETER_DAMPING, &damping, error));
}

/// Lets flesh hang on its bones: each coordinate that has one and no drive gets a spline that follows it in the rig's clip.
static bool hang_flesh(struct document *document, int rig, const struct imported *from, struct error *error)
{
    const struct character *soft = &from->figure.character;
    const int clip = gltf_find_clip(&from->gltf, document->rigs[rig]->model.clip);
    struct drive drives[MODEL_MAX_DRIVES];
    struct rig changed = *document->rigs[rig];
    struct clip_play play = {0};
    if (clip >= 0) play = clip_play(&changed.model, &from->gltf.clips[clip]);
    const struct param start = param_number(posing_clip_loops(document, &play) ? WIGGLY_LOOP : WIGGLY_REST);
    const int count = changed.model.drive_count;
    bool done = true;
    for (int d = 0; d < count; d++) drives[d] = changed.model.drives[d];
    changed.model.drives = drives;
    for (int i = 0; done && i < soft->coordinate_count && changed.model.drive_count < MODEL_MAX_DRIVES; i++) {
        const struct coordinate *coordinate = &soft->coordinates[i];
        const int spline = document->spline_count;
        bool has_drive = false;
        for (int d = 0; d < count; d++) has_drive |= strcmp(drives[d].name, coordinate->name) == 0;
        if (has_drive || !coordinate->bone || !(coordinate->frequency > 0)) continue;
        drives[changed.model.drive_count++] =
            (struct drive){.name = coordinate->name, .spline = spline, .amplitude = DRIVE_DEFAULT_AMPLITUDE};
        struct joint_motion motion = {.model = changed.name ? changed.name : changed.model.model,
                                      .joint = coordinate->bone,
                                      .of = MOTION_BASE,
                                      .gain = 1};
        const struct param equilibrium = {.track = -1, .motion = &motion};
        const struct knot knot = {.frame = document->first_frame, .value = 0.5}; // without a clip it swings at once
        done =
            add_spline(document, coordinate->name, clip < 0 && changed.model.drive_count == count + 1 ? &knot : NULL,
                       coordinate->frequency, coordinate->damping, error) &&
            edit_parameter(document, spline, PARAMETER_EQUILIBRIUM, &equilibrium, error) &&
            edit_parameter(document, spline, PARAMETER_START, &start, error);
    }
    return done && edit_rig_set(document, rig, &changed, error);
}

/// Keeps a character's paint for a file with more coordinates; if it `chose` the part, less what raised amplitudes.
static bool keep_paint(struct document *document, int rig, const struct character *soft, bool chose,
                       struct error *error)
{
    struct paint *old = paint_hold(document->rigs[rig]->model.painted);
    const int vertices = old->vertices, coordinates = (int)fmin(old->coordinates, soft->coordinate_count);
    int *vertex = need((size_t)vertices, sizeof *vertex);
    float(*values)[2] = need((size_t)vertices, sizeof *values);
    bool done =
        vertices == soft->vertex_count && edit_paint_new(document, rig, soft->coordinate_count, vertices, error);
    for (int v = 0; v < vertices; v++) vertex[v] = v;
    for (int c = 0; done && c < coordinates; c++) {
        for (int v = 0; v < vertices; v++) {
            const float *value = old->values[(size_t)c * (size_t)vertices + (size_t)v];
            values[v][0] = chose ? fminf(value[0], 0) : value[0];
            values[v][1] = value[1];
        }
        done = edit_paint(document, rig, &(struct dab){c, vertices, vertex, (const float(*)[2])values}, error);
    }
    free(vertex);
    free(values);
    paint_drop(old);
    return done;
}

bool import_flesh(struct document *document, int rig, const char *path, bool by_paint, struct error *error)
{
    char whole[PATH_LIMIT], file[PATH_LIMIT];
    struct imported soft;
    if (!path_resolve(NULL, path, whole) || !path_rebase(whole + 1, "/", document->folder, file))
        snprintf(file, sizeof file, "%s", path);
    if (!imported_read(&soft, path, error)) return false;
    const bool done =
        edit_model_file(document, rig, file, error) && hang_flesh(document, rig, &soft, error) &&
        (!document->rigs[rig]->model.painted || keep_paint(document, rig, &soft.figure.character, by_paint, error));
    imported_free(&soft);
    return done;
}

bool import_add(struct document *document, const char *path, int spline, struct error *error)
{
    char file[PATH_LIMIT];
    struct imported imported;
    if (!path_rebase(path, NULL, document->folder, file)) snprintf(file, sizeof file, "%s", path);
    if (!imported_read(&imported, path, error)) return false;
    const struct gltf *gltf = &imported.gltf;
    const struct coordinate *soft =
        imported.figure.character.coordinate_count > 0 ? imported.figure.character.coordinates : NULL;
    const struct gltf_clip *clip = gltf->clip_count > 0 ? &gltf->clips[0] : NULL;
    const bool hangs = soft && soft->bone && clip && spline < 0;
    if (hangs) soft = NULL;
    struct drive drive = {.name = soft ? soft->name : NULL, .amplitude = DRIVE_DEFAULT_AMPLITUDE};
    struct rig rig = {.kind = RIG_MODEL,
                      .model = {.model = file,
                                .clip = clip ? clip->name : NULL,
                                .scale = 1,
                                .phases = -1,
                                .drives = soft ? &drive : NULL,
                                .drive_count = soft ? 1 : 0}};

    // A tiny or huge character gets the usual size, by a scale of one digit.
    double size = 0;
    for (int k = 0; k < 3; k++) size = fmax(size, (double)(gltf->hi[k] - gltf->lo[k]));
    if (size > 0 && !(size >= SMALLEST && size <= LARGEST)) {
        const double scale = USUAL / size, digit = maths_power_of_ten(maths_decade(scale));
        rig.model.scale = round(scale / digit) * digit;
    }
    const bool is_empty = document->spline_count == 0 && document->rig_count == 0;
    bool added = !is_empty || (soft && !clip) || set_range(document, &rig.model, clip, error);
    drive.spline = spline >= 0 ? spline : document->spline_count;
    if (added && soft && spline < 0) { // by numbers that one would write, and it swings at once
        const struct knot start = {.frame = document->first_frame, .value = 0.5};
        added = add_spline(document, NULL, &start, round(soft->frequency * 100) / 100,
                           round(soft->damping * 1000) / 1000, error);
    }
    added = added && edit_rig_add(document, &rig, error) &&
            (!hangs || hang_flesh(document, document->rig_count - 1, &imported, error));
    imported_free(&imported);
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

bool import_choose_clip(struct document *document, int rig, const struct gltf *gltf, const char *clip,
                        enum clip_repeat repeat, struct error *error)
{
    const int found = gltf_find_clip(gltf, clip);
    if (!set_clip(document, rig, clip, repeat, error)) return false;

    // The frames are the clip's if nothing belongs to one: there are no knots or pins, and no splines or some that follow the clip.
    bool follows = document->spline_count == 0, has_knots = false;
    for (int s = 0; s < document->spline_count; s++) {
        has_knots |= document->splines[s]->knot_count > 0;
        follows |= follows_clip(document->splines[s]);
    }
    return found < 0 || has_knots || !follows || pins_count(document) > 0 ||
           fit_to_clip(document, rig, &gltf->clips[found], error);
}

struct document *import_with_clip(const struct document *document, int rig, const struct gltf *gltf, int clip,
                                  struct error *error)
{
    struct document *copy = document_copy(document);
    bool done = true; // knots and pins that were set for another clip go
    for (int s = 0; s < copy->spline_count; s++) {
        while (done && follows_clip(copy->splines[s]) && copy->splines[s]->knot_count > 0)
            done = edit_knot_remove(copy, s, copy->splines[s]->knots[0].id, error);
    }
    for (int r = 0; r < copy->rig_count; r++) {
        while (done && copy->rigs[r]->kind == RIG_CHAIN && copy->rigs[r]->pin_count > 0)
            done = edit_pin_remove(copy, r, copy->rigs[r]->pins[0].id, error);
    }
    if (done && set_clip(copy, rig, gltf->clips[clip].name, REPEAT_BY_CLIP, error) &&
        fit_to_clip(copy, rig, &gltf->clips[clip], error))
        return copy;
    document_destroy(copy);
    return NULL;
}

// --- chains

static const double USUAL_LENGTH = 0.5, USUAL_FREQUENCY = 1.5; ///< longer chains swing slower, like a pendulum
static const double SLOWEST = 0.8, FASTEST = 3.5, USUAL_DAMPING = 0.12;
static const double WHOLE_LAG = 110;  ///< degrees from the first bone to the tip
static const double WHOLE_BEND = 110; ///< degrees for 1 of a spline whose knots plan_set it
static const double LEAST_SWING = 1; ///< degrees by chain_bend_a_metre(): what is less stays less, as it may be noise
static const double DEGREES = 57.29577951308232;
static const double SHORTEST = 1e-3; ///< of the character's size; less cannot be bent
static const double LEAF = 0.03;     ///< of that size: length of a bone without a child, at least

/// The diagonal of the character's box, metres.
static double size_of(const struct imported *imported, double scale)
{
    double square = 0;
    for (int k = 0; k < 3; k++) square += pow((double)imported->gltf.hi[k] - (double)imported->gltf.lo[k], 2);
    return scale * sqrt(square);
}

/// Length along the bones at rest, metres.
static double length_of(const struct imported *imported, const struct chain_bones *bones, double scale)
{
    float point[ANGLES_MAX_JOINTS + 1][3];
    double sum = 0;
    chain_points_at_rest(imported, bones, point);
    for (int n = 1; n <= bones->count; n++) {
        const float *a = point[n - 1], *b = point[n];
        sum += maths_hypot(maths_hypot((double)(b[0] - a[0]), (double)(b[1] - a[1])), (double)(b[2] - a[2]));
    }
    const bool is_leaf = bones->count == 1 && imported->gltf.nodes[bones->node[0]].child < 0; // its tip is a guess
    return is_leaf ? fmax(scale * sum, LEAF * size_of(imported, scale)) : scale * sum;
}

double chain_bend_a_metre(const struct imported *imported, const struct chain_bones *bones, double scale)
{
    // A bend of g at each of n bones moves the tip by g · length · (n + 1) / 2.
    const double length = fmax(length_of(imported, bones, scale), fmax(SHORTEST * size_of(imported, scale), 1e-6));
    return DEGREES * 2 / (length * (bones->count + 1));
}

static double three_digits(double number)
{
    const double unit = 100 / maths_power_of_ten(maths_decade(number));
    return round(unit * number) / unit;
}

/// Scales the gains of a new chain that follows a clip, by CHAIN_SWING.
static bool set_strength(struct document *document, const struct models *models, int rig, int bones,
                         struct error *error)
{
    struct evaluation evaluation = {.models = models_source(models)};
    evaluation_update(&evaluation, document, false);
    const struct posing posing = {.document = document, .evaluation = &evaluation, .models = models};
    const struct chain *chain = &document->rigs[rig]->chain;
    double largest = LEAST_SWING;
    for (int s = 0; s < evaluation.samples; s++) {
        wiggly_value values[RIG_MAX_INPUTS];
        double turn[2] = {0};
        posing_values(&posing, rig, s, values);
        for (int i = 0; i < 2 * bones; i++)
            turn[i % 2] += channel_bend(&chain->channels[i % 2], values[i % 2], i / 2, bones, LOOK_WIGGLY);
        largest = fmax(largest, DEGREES * maths_hypot(turn[0], turn[1]));
    }
    evaluation_free(&evaluation);
    const double gain = three_digits(chain->channels[0].gain.value[0] * CHAIN_SWING / largest);
    bool done = true;
    for (int c = 0; c < 2; c++) {
        struct channel channel = document->rigs[rig]->chain.channels[c];
        channel.gain.value[0] = gain;
        done = done && edit_channel(document, (struct channel_place){rig, c}, &channel, error);
    }
    return done;
}

bool chain_make(struct document *document, const struct models *models, const struct chain_wish *wish, int *rig,
                struct error *error)
{
    const struct rig *model = document->rigs[wish->model];
    const struct imported *imported = models_imported(models, document, wish->model);
    struct chain_bones bones;
    if (!imported)
        return fail(error, ERROR_INPUT, "%s: it could not be read, so it has no bones", model->model.model);
    const struct gltf *gltf = &imported->gltf;
    const int from = gltf_find_node(gltf, wish->from);
    const int last = wish->to || from < 0 ? -1 : chain_end(imported, from, error);
    if (from >= 0 && !wish->to && last < 0) return false;
    const char *to = wish->to ? wish->to : last < 0 ? wish->from : gltf->nodes[last].name;
    if (!chain_find(gltf, wish->from, to, &bones, error)) return false;
    const int clip = gltf_find_clip(gltf, model->model.clip);
    struct clip_play play = {0};
    if (clip >= 0) play = clip_play(&model->model, &gltf->clips[clip]);
    const double length = length_of(imported, &bones, model->model.scale);
    if (!(length > SHORTEST * size_of(imported, model->model.scale)))
        return fail(error, ERROR_INPUT,
                    "%s: the bones \"%s\" to \"%s\" lie at one place, so there is nothing to bend: choose others",
                    model->model.model, wish->from, to);
    const double frequency = fmin(fmax(USUAL_FREQUENCY * sqrt(USUAL_LENGTH / length), SLOWEST), FASTEST);

    // The first bone's name without the number at the end, made unique.
    char other[BONE_NAME_SIZE], *stem = need_text(wish->from);
    const bool has_side = bone_other_side(wish->from, other); // ear_1_L keeps its whole name
    size_t letters = strlen(stem);
    while (!has_side && letters > 1 && isdigit((unsigned char)stem[letters - 1])) letters--;
    while (!has_side && letters > 1 && strchr("_-. ", stem[letters - 1])) letters--;
    stem[letters] = '\0';
    char *name = edit_rig_free_name(document, stem);
    free(stem);

    struct chain chain = {.model = model->name ? model->name : model->model.model,
                          .from = gltf->nodes[bones.node[0]].name,
                          .to = gltf->nodes[bones.node[bones.count - 1]].name};
    const struct chain *twin = NULL;
    for (int r = -1; has_side && !wish->own && !twin && (r = document_next_chain(document, wish->model, r)) >= 0;) {
        if (strcmp(document->rigs[r]->chain.from, other) == 0) twin = &document->rigs[r]->chain;
    }
    const double bend =
        wish->follows ? chain_bend_a_metre(imported, &bones, model->model.scale) : WHOLE_BEND / bones.count;
    struct channel channels[2];
    const int first = document->spline_count;
    const double hertz = wish->frequency > 0 ? wish->frequency : round(10 * frequency) / 10;
    const double ratio = wish->damping > 0 ? wish->damping : USUAL_DAMPING;
    const bool loops = document_loops(document) || posing_clip_loops(document, &play);
    const struct param start = param_number(loops ? WIGGLY_LOOP : WIGGLY_REST);
    bool done = true;
    if (twin) {
        chain.turn = -twin->turn;
        chain.mirror = !twin->mirror;
        chain.channels = twin->channels;
        chain.channel_count = twin->channel_count;
    } else {
        for (int c = 0; c < 2; c++) { // each bent by a spline of its own
            char *spline;
            if (asprintf(&spline, "%s %s", name, c == 0 ? "side" : "up") < 0) need_failed();
            done = done && add_spline(document, spline, NULL, hertz, ratio, error) &&
                   edit_parameter(document, first + c, PARAMETER_START, &start, error);
            free(spline);
            channels[c] = (struct channel){.spline = first + c,
                                           .axis = c == 0 ? AXIS_SIDE : AXIS_UP,
                                           .of = wish->follows ? PART_DISPLACEMENT : PART_TOTAL,
                                           .lag.value = {wish->lag > 0 ? wish->lag : round(WHOLE_LAG / bones.count)},
                                           .gain.value = {three_digits(bend)}};
        }
        chain.channels = channels;
        chain.channel_count = 2;
    }
    const struct rig contents = {.kind = RIG_CHAIN, .name = name, .chain = chain};
    *rig = document->rig_count;
    done = done && edit_rig_add(document, &contents, error);
    const bool follows = wish->follows && !twin;
    for (int c = 0; done && follows && c < 2; c++) { // the stiff chain's tip through the clip
        struct joint_motion motion = {.model = chain.model,
                                      .joint = chain.to,
                                      .of = c == 0 ? MOTION_ACROSS : MOTION_UP,
                                      .gain = 1,
                                      .chain = name};
        const struct param equilibrium = {.track = -1, .motion = &motion};
        done = edit_parameter(document, first + c, PARAMETER_EQUILIBRIUM, &equilibrium, error);
    }
    if (done && follows && clip >= 0) done = set_strength(document, models, *rig, bones.count, error);
    free(name);
    return done;
}

// --- opened for a command

static bool read_models(struct opened *opened, struct error *error)
{
    opened->models = models_create();
    if (scene_read_paint(opened->document, error) && models_update(opened->models, opened->document, error))
        return true;
    opened_free(opened);
    return false;
}

bool opened_read_splines(struct opened *opened, const char *path, struct error *error)
{
    *opened =
        (struct opened){.document = import_suits(path) ? import_scene(path, error) : scene_load(path, NULL, error)};
    if (!opened->document) return false;
    document_note_models(opened->document);
    bool needs_models = pins_hold_any(opened->document);
    for (int s = 0; s < opened->document->spline_count; s++)
        needs_models |= follows_clip(opened->document->splines[s]);
    return !needs_models || read_models(opened, error);
}

bool opened_read(struct opened *opened, const char *path, struct error *error)
{
    return opened_read_splines(opened, path, error) && (opened->models || read_models(opened, error));
}

void opened_solve(struct opened *opened, enum solver_choice solver)
{
    opened->evaluation.solver = solver;
    opened->evaluation.models = models_source(opened->models);
    evaluation_update(&opened->evaluation, opened->document, false);
}

void opened_free(struct opened *opened)
{
    evaluation_free(&opened->evaluation);
    models_destroy(opened->models);
    document_destroy(opened->document);
    *opened = (struct opened){0};
}

struct posing opened_posing(const struct opened *opened)
{
    return (struct posing){.document = opened->document, .evaluation = &opened->evaluation, .models = opened->models};
}
