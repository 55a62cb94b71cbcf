/// A document under edit.
#include "world.h"

static const char scene_text[] =
    "{\"frames\": [0, 48], \"splines\": ["
    "{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0, \"tag\": 1}, "
    "{\"frame\": 12, \"value\": 1, \"slope\": 0}, {\"frame\": 30, \"value\": -1}]},"
    "{\"name\": \"pluck\", \"mode\": \"real\", \"spring\": 40, \"friction\": 1, \"start\": \"rest\"},"
    "{\"name\": \"loop\", \"start\": \"loop\", \"equilibrium\": {\"spline\": \"sway\"}, \"knots\": [{\"frame\": 3, "
    "\"value\": 2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 3, \"channels\": [{\"spline\": \"sway\"}, "
    "{\"spline\": \"loop\", \"axis\": \"up\", \"gain\": [1, 2, 3]}]}]}";

void world_open(struct world *world) { world_open_scene(world, scene_text); }

void world_open_scene(struct world *world, const char *scene)
{
    *world = (struct world){0};
    world->document = document_of_text(scene);
    world->history = history_create(world->document);
    assert_non_null(world->history);
}

void world_close(struct world *world)
{
    while (world->printed_count > 0) free(world->printed[--world->printed_count]);
    free(world->printed);
    history_destroy(world->history);
    document_destroy(world->document);
}

const char *world_print(struct world *world)
{
    const size_t count = (size_t)++world->printed_count;
    world->printed = realloc(world->printed, count * sizeof *world->printed);
    assert_non_null(world->printed);
    return world->printed[count - 1] = text_of_document(world->document);
}

void assert_document(const struct world *world, const char *expected) { assert_prints(world->document, expected); }

struct document *world_edit(struct world *world)
{
    if (history_is_open(world->history)) return world->document;
    world->before = document_copy(world->document);
    world->label = history_label(world->history, history_done(world->history) - 1);
    history_begin(world->history, "Step", 0);
    return world->document;
}

/// Closes the step; the text of what was there before it, if that is wanted.
static char *end_step(struct world *world, bool wanted)
{
    char *text = wanted ? text_of_document(world->before) : NULL;
    history_end(world->history);
    document_destroy(world->before);
    world->before = NULL;
    return text;
}

bool world_step(struct world *world, bool done)
{
    end_step(world, false);
    return done;
}

void world_must(struct world *world, bool done)
{
    if (!world_step(world, done)) fail_msg("%s", world->error.text);
}

void assert_refused(struct world *world, bool done, const char *sentence)
{
    char *before = end_step(world, true);
    assert_false(done);
    assert_int_equal(world->error.kind, ERROR_INPUT);
    assert_string_equal(world->error.text, sentence);
    assert_document(world, before);
    assert_ptr_equal(history_label(world->history, history_done(world->history) - 1), world->label);
    free(before);
}

void assert_reversible(struct world *world, bool done)
{
    char *before = end_step(world, true);
    if (!done) fail_msg("%s", world->error.text);
    char *after = text_of_document(world->document);
    assert_string_not_equal(before, after);
    assert_true(history_undo(world->history));
    assert_document(world, before);
    assert_true(history_redo(world->history));
    assert_document(world, after);
    free(before);
    free(after);
}

bool edit_insert(struct world *world, int spline, double frame, double value)
{
    const struct knot knot = {.frame = frame, .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS};
    return edit_knot_insert(world_edit(world), spline, &knot, &world->error);
}

bool edit_frames(struct world *world, int first, int last)
{
    return edit_range(world_edit(world), first, last, RANGE_REFUSE, &world->error);
}

bool edit_bend(struct world *world, int rig, int channel, int spline, int axis, int of)
{
    struct document *document = world_edit(world);
    struct channel changed = {.spline = 0};
    int count;
    const struct channel *channels = rig_channels(document->rigs[rig], &count);
    if (channel < count) changed = channels[channel];
    if (spline >= 0) changed.spline = spline;
    if (axis >= 0) changed.axis = (enum axis)axis;
    if (of >= 0) changed.of = (enum channel_part)of;
    return edit_channel(document, (struct channel_place){rig, channel}, &changed, &world->error);
}

// --- edits in words

enum { MOST_WORDS = 12 };

/// An edit's words, and what they are as numbers, as a spline and as a rig.
struct words {
    char text[256], *word[MOST_WORDS];
    double number[MOST_WORDS];
    int count, spline, rig;
};

static int spline_called(const struct document *document, const char *word)
{
    const int spline = document_find_spline(document, word);
    return spline >= 0 ? spline : atoi(word);
}

static int rig_called(const struct document *document, const char *word)
{
    for (int r = 0; r < document->rig_count; r++) {
        const char *name = document->rigs[r]->name;
        if (name && strcmp(name, word) == 0) return r;
    }
    return atoi(word);
}

static int word_among(const char *word, const char *const *words)
{
    for (int i = 0; words[i]; i++)
        if (strcmp(words[i], word) == 0) return i;
    return atoi(word);
}

static int axis_called(const char *word)
{
    for (int axis = 0; axis < AXES; axis++)
        if (strcmp(axis_word((enum axis)axis), word) == 0) return axis;
    return atoi(word);
}

static void split(struct words *words, const struct document *document, const char *edit)
{
    char *rest = words->text, *word;
    snprintf(words->text, sizeof words->text, "%s", edit);
    words->count = 0;
    while ((word = strsep(&rest, " "))) {
        assert_in_range(words->count, 0, MOST_WORDS - 1);
        words->number[words->count] = strtod(word, NULL);
        words->word[words->count++] = strcmp(word, "''") == 0 ? word + 2 : word;
    }
    for (int i = words->count; i < MOST_WORDS; i++) words->number[i] = 0, words->word[i] = "";
    words->spline = spline_called(document, words->word[1]);
    words->rig = rig_called(document, words->word[1]);
}

static enum parameter parameter_called(const char *name)
{
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++)
        if (strncmp(parameter_rows[p].name, name, strlen(name)) == 0) return p;
    return *name >= '0' && *name <= '9' ? (enum parameter)atoi(name) : PARAMETER_COUNT;
}

static bool is(const struct words *w, const char *verb) { return strcmp(w->word[0], verb) == 0; }

#define NUMBER(i) ((int)w->number[i])

/// An edit of splines; −1 if it is none.
static int do_spline(struct document *d, const struct words *w, struct error *error)
{
    const bool is_there = w->spline >= 0 && w->spline < d->spline_count;
    const struct spline *spline = is_there ? d->splines[w->spline] : NULL;
    const enum parameter parameter = parameter_called(w->word[2]);
    struct knot knot = {.frame = w->number[2], .value = w->number[3], .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (is(w, "insert")) return edit_knot_insert(d, w->spline, &knot, error);
    knot.id = 9999;
    int at = NUMBER(2);
    if (spline && w->word[2][0] == '@') at = spline_find_knot(d, spline, document_sample(d, atof(w->word[2] + 1)));
    if (spline && at >= 0 && at < spline->knot_count) knot = spline->knots[at];
    if (is(w, "remove")) return edit_knot_remove(d, w->spline, knot.id, error);
    if (is(w, "move")) knot.frame = w->number[3], knot.value = w->number[4];
    if (is(w, "knot")) {
        if (strcmp(w->word[3], "slope") == 0) knot.has_slope = true, knot.slope = w->number[4];
        if (strcmp(w->word[3], "im") == 0) knot.has_phase = true, knot.phase = w->number[4];
        if (strcmp(w->word[3], "stiffness") == 0) knot.stiffness = w->number[4];
        if (strcmp(w->word[3], "still") == 0) knot.still = NUMBER(4);
        if (strcmp(w->word[3], "settles") == 0) knot.settles = NUMBER(4);
    }
    if (is(w, "move") || is(w, "knot")) return edit_knot_set(d, w->spline, &knot, error);
    if (is(w, "set")) {
        struct param param = param_number(w->number[3]);
        if ((unsigned)parameter < PARAMETER_COUNT && parameter_rows[parameter].kind == PARAMETER_CHOICE)
            param.value = word_among(w->word[3], parameter_rows[parameter].words);
        return edit_parameter(d, w->spline, parameter, &param, error);
    }
    if (is(w, "track")) {
        const struct param param = param_track(spline_called(d, w->word[3]));
        return edit_parameter(d, w->spline, parameter, &param, error);
    }
    if (is(w, "follow")) {
        struct joint_motion motion = {.model = w->word[3], .joint = w->word[4], .gain = w->number[6]};
        motion.of = (enum motion_of)word_among(w->word[5], motion_words);
        if (w->word[7][0]) motion.chain = w->word[7];
        return edit_parameter(d, w->spline, parameter, &(struct param){.track = -1, .motion = &motion}, error);
    }
    if (is(w, "settle")) return edit_spline_settles(d, w->spline, NUMBER(2), error);
    if (is(w, "add")) {
        const struct knot first = {.frame = w->number[3], .value = w->number[4]};
        const char *name = strcmp(w->word[2], "-") == 0 ? NULL : w->word[2];
        return edit_spline_add(d, NUMBER(1), name, w->count > 3 ? &first : NULL, error);
    }
    if (is(w, "copy")) return edit_spline_copy(d, w->spline, error);
    if (is(w, "drop")) return edit_spline_remove(d, w->spline, error);
    if (is(w, "order")) return edit_spline_move(d, w->spline, NUMBER(2), error);
    if (is(w, "name")) return edit_spline_name(d, w->spline, w->word[2], error);
    if (is(w, "color")) return edit_spline_color(d, w->spline, NUMBER(2), error);
    if (is(w, "folder")) return edit_spline_folder(d, w->spline, w->count > 2 ? w->word[2] : "", error);
    if (is(w, "lock")) return edit_spline_lock(d, w->spline, NUMBER(2), error);
    return -1;
}

/// The numbers from the fourth word on.
static struct angles angles_said(const struct words *w)
{
    struct angles angles = {.count = w->count - 4, .form = w->count > 5 ? ANGLES_EACH : ANGLES_ONE};
    if (strchr(w->word[4], ':')) angles.form = ANGLES_RAMP;
    for (int i = 0; i < angles.count; i++) {
        const char *colon = strchr(w->word[4 + i], ':');
        if (colon) angles.ramp[i] = (struct ramp_point){w->number[4 + i], atof(colon + 1)};
        if (!colon) angles.value[i] = w->number[4 + i];
    }
    return angles;
}

/// An edit of a rig's channels, drives or pins; −1 if it is none.
static int do_part(struct world *world, const struct words *w, struct error *error)
{
    static const char *const kinds[] = {"rest", "lag", "gain", NULL};
    static const char *const parts[] = {"total", "displacement", NULL};
    struct document *d = world->document;
    const bool is_there = w->rig >= 0 && w->rig < d->rig_count;
    const struct channel_place at = {w->rig, NUMBER(2)};
    if (is(w, "angles")) {
        const struct angles angles = angles_said(w);
        return edit_angles(d, at, (enum angle_kind)word_among(w->word[3], kinds), &angles, error);
    }
    if (is(w, "bend")) {
        if (!is_there) return edit_channel(d, at, &(struct channel){0}, error);
        const int spline = w->word[3][0] == '-' ? -1 : spline_called(d, w->word[3]);
        const int axis = w->word[4][0] == '-' ? -1 : axis_called(w->word[4]);
        const int part = w->word[5][0] == '-' ? -1 : word_among(w->word[5], parts);
        return edit_bend(world, w->rig, at.channel, spline, axis, part);
    }
    if (is(w, "channel"))
        return edit_channel_add(d, w->rig, spline_called(d, w->word[2]), (enum axis)axis_called(w->word[3]),
                                (enum channel_part)word_among(w->word[4], parts), error);
    if (is(w, "unchannel")) return edit_channel(d, at, NULL, error);
    if (is(w, "drive")) {
        const struct rig *rig = is_there && d->rigs[w->rig]->kind == RIG_MODEL ? d->rigs[w->rig] : NULL;
        struct drive drive = {.name = w->word[6]};
        if (rig && NUMBER(2) >= 0 && NUMBER(2) < rig->model.drive_count) drive = rig->model.drives[NUMBER(2)];
        drive.spline = spline_called(d, w->word[3]), drive.amplitude = w->number[4], drive.lag = w->number[5];
        return edit_drive(d, w->rig, NUMBER(2), &drive, error);
    }
    if (is(w, "undrive")) return edit_drive(d, w->rig, NUMBER(2), NULL, error);
    const int first = is(w, "pin") ? 2 : 3;
    struct pin pin = {.frame = w->number[first], .point = NUMBER(first + 1), .id = first == 2 ? 0 : 9999};
    for (int k = 0; k < 3; k++) pin.to[k] = w->number[first + 2 + k];
    if (is_there && first == 3 && NUMBER(2) < d->rigs[w->rig]->pin_count)
        pin.id = d->rigs[w->rig]->pins[NUMBER(2)].id;
    if (is(w, "pin") || is(w, "repin")) return edit_pin_set(d, w->rig, &pin, error);
    if (is(w, "unpin")) return edit_pin_remove(d, w->rig, pin.id, error);
    return -1;
}

/// An edit of the scene's frames or of rigs; −1 if it is none.
static int do_rig(struct document *d, const struct words *w, struct error *error)
{
    static const char *const fits[] = {"refuse", "move", "trim", NULL};
    if (is(w, "fps")) return edit_fps(d, w->number[1], w->count > 2, error);
    if (is(w, "background"))
        return edit_background(d, &(struct background_file){w->count > 1 ? w->word[1] : NULL, NUMBER(2), NULL},
                               error);
    if (is(w, "substeps")) return edit_substeps(d, NUMBER(1), error);
    if (is(w, "range"))
        return edit_range(d, NUMBER(1), NUMBER(2), (enum range_fit)word_among(w->word[3], fits), error);
    if (is(w, "tail")) return edit_tail_add(d, w->rig, spline_called(d, w->word[2]), error);
    if (is(w, "unrig")) return edit_rig_remove(d, w->rig, error);
    if (is(w, "rename")) return edit_rig_name(d, w->rig, w->word[2], error);
    if (is(w, "joints")) return edit_joints(d, w->rig, NUMBER(2), error);
    struct rig changed = {.kind = RIG_TAIL};
    int wanted = 0;
    if (w->rig >= 0 && w->rig < d->rig_count) changed = *d->rigs[w->rig];
    if (is(w, "length")) wanted = 1, changed.tail.length = w->number[2];
    if (is(w, "place")) wanted = 1, changed.tail.position[NUMBER(2)] = param_number(w->number[3]);
    if (is(w, "ride")) wanted = 1, changed.tail.position[NUMBER(2)] = param_track(spline_called(d, w->word[3]));
    if (is(w, "clip")) wanted = 1, changed.model.clip = w->word[2];
    if (is(w, "turn")) wanted = 1, changed.chain.turn = w->number[2];
    if (is(w, "offset")) wanted = 1, changed.offset = w->number[2];
    if (is(w, "floor")) wanted = 1, changed.model.has_floor = true, changed.model.floor = w->number[2];
    return wanted ? edit_rig_set(d, w->rig, &changed, error) : -1;
}

bool world_do(struct world *world, const char *edit)
{
    struct words words;
    struct document *document = world_edit(world);
    split(&words, document, edit);
    int done = do_spline(document, &words, &world->error);
    if (done < 0) done = do_rig(document, &words, &world->error);
    if (done < 0) done = do_part(world, &words, &world->error);
    if (done < 0) fail_msg("there is no edit \"%s\"", edit);
    return done;
}

bool world_do_all(struct world *world, const char *edits)
{
    for (const char *end; (end = strchr(edits, ';')); edits = end + 2) {
        char edit[256];
        snprintf(edit, sizeof edit, "%.*s", (int)(end - edits), edits);
        if (!world_step(world, world_do(world, edit))) fail_msg("%s: %s", edit, world->error.text);
    }
    return world_do(world, edits);
}

void assert_edits(const char *scene, const char *edits, const char *says)
{
    for (const char *end; edits; edits = end ? end + 2 : NULL) {
        struct world world;
        char edit[256];
        end = strchr(edits, '|');
        snprintf(edit, sizeof edit, "%.*s", end ? (int)(end - edits - 1) : 255, edits);
        world_open_scene(&world, scene);
        const bool done = world_do_all(&world, edit), is_refusal = says && *says;
        if (done == is_refusal || (is_refusal && strcmp(world.error.text, says) != 0))
            fail_msg("%s: %s, not: %s", edit, done ? "it is done" : world.error.text, is_refusal ? says : "done");
        if (is_refusal) assert_refused(&world, done, says);
        if (!is_refusal) world_must(&world, done);
        if (says && !*says && history_count(world.history) > 0) fail_msg("%s: it is a step", edit);
        world_close(&world);
    }
}

int world_undo_all(struct world *world)
{
    int count = 0;
    while (history_undo(world->history)) count++;
    return count;
}
