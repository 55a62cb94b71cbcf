/// Plays the steps of hands.h.
#include "hands.h"
#include "export/export.h"
#include "scene/document.h"
#include <jansson.h>

enum { MOST_WORDS = 40, MOST_NUMBERS = 64, MOST_SAMPLES = 512, MOST_CURVES = 3, MOST_KEPT = 8, MOST_TEXT = 512 };

/// The curves at the last `keep`.
static double kept_total[MOST_CURVES][MOST_SAMPLES];
/// The numbers of names that were kept.
static struct {
    char name[64];
    double number;
} kept_number[MOST_KEPT];

/// One step, while it is played.
struct played {
    struct session *s;
    const char *all;        ///< the steps
    char text[MOST_TEXT];   ///< the step
    char words[MOST_TEXT];  ///< what word[] points into
    char *word[MOST_WORDS]; ///< the rest is NULL
    const char *rest;       ///< the text behind the first word
    int count;
};

#define WRONG(step, format, ...) fail_msg("%s: " format "\n  in: %s", (step)->text, __VA_ARGS__, (step)->all)

static const char *word(const struct played *step, int i)
{
    if (i >= step->count) WRONG(step, "%d words are too few", step->count);
    return step->word[i];
}

static double number_in(const struct played *step, const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end) WRONG(step, "%s is no number", text);
    return value;
}

/// The whole number that is the i-th word, if there is one.
static int times(const struct played *step, int i, int otherwise)
{
    return step->word[i] ? (int)number_in(step, step->word[i]) : otherwise;
}

/// The text behind one of its words.
static const char *behind(const struct played *step, const char *word)
{
    const char *at = step->text + (word - step->words) + strlen(word);
    return at + strspn(at, " ");
}

// --- does ---

/// Where a target of replays is, or a widget of the inspector, where _ may be written for a space.
static bool find_place(struct editor *e, const char *target, float xy[2], struct error *why)
{
    char name[64];
    if (strchr(target, '(')) return editor_target(e, target, &xy[0], &xy[1], why);
    if (widget_at(e, target, &xy[0], &xy[1])) return true;
    snprintf(name, sizeof name, "%s", target);
    for (char *at = name; (at = strchr(at, '_'));) *at = ' ';
    if (widget_at(e, name, &xy[0], &xy[1])) return true;
    return fail(why, ERROR_INPUT, "the inspector does not show it");
}

static void point(const struct played *step, int i)
{
    struct error why = {0};
    float xy[2];
    if (!find_place(step->s->editor, word(step, i), xy, &why)) WRONG(step, "%s", why.text);
    session_move(step->s, xy[0], xy[1]);
}

/// A way in pixels.
static float way(const struct played *step, const char *text)
{
    const struct plotted *view = plot_of(step->s->editor);
    const struct rect *plot = &layout_of(step->s->editor)->plot;
    char *unit;
    const double value = strtod(text, &unit);
    if (*unit == 'f') return (float)(value * (double)plot->w / (view->frame1 - view->frame0));
    if (*unit == 'v') return (float)(-value * (double)plot->h / (view->value1 - view->value0));
    return (float)number_in(step, text);
}

/// By the words from the i-th on.
static void drag(const struct played *step, int i)
{
    session_drag(step->s, way(step, word(step, i)), way(step, word(step, i + 1)), times(step, i + 2, 4));
}

/// "Ctrl+Shift+" before a name; moves on to the name.
static unsigned modifiers(const char **name)
{
    static const struct {
        const char *name;
        unsigned mod;
    } rows[] = {{"Ctrl", MOD_CTRL}, {"Shift", MOD_SHIFT}, {"Alt", MOD_ALT}};
    unsigned mods = 0;
    for (int i = 0; i < 3; i++) {
        const size_t length = strlen(rows[i].name);
        if (strncmp(*name, rows[i].name, length) != 0) continue;
        mods |= rows[i].mod;
        *name += length;
        *name += **name == '+' && (*name)[1] != '\0';
        i = -1;
    }
    return mods;
}

static int key_of(const struct played *step, const char *name)
{
    const int key = key_from_name(name);
    if (!key) WRONG(step, "%s is no key", name);
    return key;
}

static void keys(const struct played *step)
{
    for (int i = 1; i < step->count; i++) {
        const char *star = strchr(step->word[i], '*'), *name = star ? star + 1 : step->word[i];
        const int often = star ? atoi(step->word[i]) : 1;
        const unsigned mods = modifiers(&name);
        for (int n = 0; n < often; n++) session_key(step->s, key_of(step, name), mods);
    }
}

/// Goes on with Tab until a widget has the focus.
static void tab(const struct played *step)
{
    const struct ui *ui = inspector_of(step->s->editor);
    for (int i = 0; !ui->focus || ui->focus != panel_id(step->s, word(step, 1)); i++) {
        if (i == UI_MAX_FOCUS) WRONG(step, "%s", "Tab does not reach it");
        session_key(step->s, KEY_TAB, 0);
    }
}

/// Clicks on a text, wherever it is drawn.
static void tap(const struct played *step)
{
    const struct draw_command *text = shown_text(step->s->editor, step->rest);
    if (!text) WRONG(step, "%s", "it is not drawn");
    session_move(step->s, text->x + 4, text->y - 4);
    session_click_here(step->s, 1);
}

static void paste(struct session *s, const char *text)
{
    char *own = strdup(*text ? text : copied(s->editor));
    assert_non_null(own);
    session_send(s, (struct event){.kind = EVENT_PASTE, .text = own});
    session_frame(s);
    free(own);
}

/// Presses a slider of the inspector and moves its handle to a value; also where it is there, that is a drag.
static void slide(const struct played *step)
{
    char target[64];
    struct error why = {0};
    float xy[2];
    point(step, 1);
    session_press(step->s, BUTTON_LEFT, 1);
    snprintf(target, sizeof target, "%s,%s", word(step, 1), word(step, 2));
    if (!find_place(step->s->editor, target, xy, &why)) WRONG(step, "%s", why.text);
    session_move(step->s, xy[0] + 3, xy[1]);
    session_move(step->s, xy[0], xy[1]);
    session_frame(step->s);
}

/// How many curves and samples of them `keep` keeps.
static void kept_of(const struct session *s, int *curves, int *samples)
{
    *curves = s->document->spline_count < MOST_CURVES ? s->document->spline_count : MOST_CURVES;
    *samples = s->work.evaluation.samples < MOST_SAMPLES ? s->work.evaluation.samples : MOST_SAMPLES;
}

static void keep(struct session *s)
{
    int curves, samples;
    kept_of(s, &curves, &samples);
    s->kept = session_saved(s);
    for (int i = 0; i < curves; i++)
        memcpy(kept_total[i], s->work.evaluation.curves[i].total, (size_t)samples * sizeof(double));
}

/// The number of a name, for "kept" in later steps of the session.
static void keep_number(const struct played *step)
{
    int i = 0;
    while (kept_number[i].name[0] && strcmp(kept_number[i].name, step->rest) != 0)
        if (++i == MOST_KEPT) WRONG(step, "%s", "too many numbers are kept");
    snprintf(kept_number[i].name, sizeof kept_number[i].name, "%s", step->rest);
    kept_number[i].number = number(step->s, step->rest);
}

#define IS(name) (strcmp(step->word[0], name) == 0)

/// A press, a drag and a release, or some of them; returns false if the step is none.
static bool strokes(const struct played *step)
{
    const bool drags = IS("drag"), pulls = IS("pull") || IS("carry"), clicks = IS("click") || IS("again");
    const bool boxes = IS("box"), releases = IS("release") || IS("carry") || clicks || boxes;
    if (IS("press") || pulls || clicks || boxes) {
        if (step->count > 1) point(step, 1);
        session_press(step->s, BUTTON_LEFT, IS("again") ? 2 : 1);
    } else if (!drags && !releases) {
        return false;
    }
    if (drags || pulls) drag(step, pulls ? 2 : 1);
    if (boxes) {
        point(step, 2);
        session_frame(step->s);
    }
    if (releases) session_release(step->s, BUTTON_LEFT);
    return true;
}

/// What else a user does; returns false if the step is none.
static bool does(const struct played *step)
{
    struct session *s = step->s;
    const char *mods = step->rest;
    if (IS("point") || IS("hover")) {
        point(step, 1);
        if (IS("hover")) session_frame(s);
    } else if (IS("at")) {
        session_move(s, (float)number_in(step, word(step, 1)), (float)number_in(step, word(step, 2)));
        session_frame(s);
    } else if (IS("tap")) {
        tap(step);
    } else if (IS("slide")) {
        slide(step);
    } else if (IS("with")) {
        s->mods = modifiers(&mods);
    } else if (IS("key")) {
        keys(step);
    } else if (IS("tab")) {
        tab(step);
    } else if (IS("hold") || IS("let")) {
        session_hold(s, key_of(step, word(step, 1)), IS("hold") ? ACTION_PRESS : ACTION_RELEASE);
    } else if (IS("type")) {
        panel_type(s, step->rest);
    } else if (IS("paste")) {
        paste(s, step->rest);
    } else if (IS("enter")) {
        point(step, 1);
        session_click_here(s, 2);
        panel_type(s, behind(step, word(step, 1)));
        session_key(s, KEY_ENTER, 0);
    } else if (IS("wheel")) {
        for (int i = times(step, 2, 1); i > 0; i--) session_wheel(s, (float)number_in(step, word(step, 1)));
    } else if (IS("wait")) {
        for (int i = times(step, 1, 1); i > 0; i--) session_frame(s);
    } else if (IS("pass")) {
        editor_advance(s->editor, number_in(step, word(step, 1)));
    } else if (IS("seek")) {
        seek(s->editor, number_in(step, word(step, 1)));
        session_frame(s);
    } else if (IS("more")) {
        show_more(s->editor, strcmp(step->rest, "off") != 0);
        session_frame(s);
    } else if (IS("keep") && *step->rest) {
        keep_number(step);
    } else if (IS("keep")) {
        keep(s);
    } else {
        return false;
    }
    return true;
}

// --- the app ---

/// The request that a step names first.
static enum request_kind request_of(const struct played *step)
{
    static const char *const names[] = {
        [REQUEST_NONE] = "nothing",    [REQUEST_OPEN] = "open",       [REQUEST_ADD] = "add",
        [REQUEST_SAVE] = "save",       [REQUEST_SAVE_AS] = "save-as", [REQUEST_QUIT] = "quit",
        [REQUEST_RECOVER] = "recover", [REQUEST_FORGET] = "forget",   [REQUEST_SCREENSHOT] = "screenshot",
        [REQUEST_EXPORT] = "export",   [REQUEST_EXPORT_STOP] = "stop"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i] && strcmp(names[i], word(step, 1)) == 0) return (enum request_kind)i;
    WRONG(step, "there is no request %s", step->word[1]);
    return REQUEST_NONE;
}

/// What the app does; returns false if the step is none.
static bool runs(const struct played *step)
{
    static const struct recovery_offer unsaved = {"walk.json", "21 November 2026, 10:00:00", 1};
    struct session *s = step->s;
    if (IS("asks")) {
        const struct request request = session_asked(s);
        if (request.kind != request_of(step) || strcmp(request.path, behind(step, step->word[1])) != 0)
            WRONG(step, "it was asked for %d \"%s\"", (int)request.kind, request.path);
    } else if (IS("answer")) {
        const char *refusal = behind(step, word(step, 1));
        panel_answer(s, request_of(step), !*refusal, refusal);
    } else if (IS("path")) {
        set_path(s->editor, step->rest);
    } else if (IS("tell")) {
        tell(s->editor, false, "%s", step->rest);
    } else if (IS("opened")) {
        editor_open(s->editor, &s->world);
    } else if (IS("close")) {
        session_send(s, (struct event){.kind = EVENT_CLOSE});
    } else if (IS("offer") || IS("welcome")) {
        if (IS("offer")) offer_recovery(s->editor, &unsaved);
        if (IS("welcome")) welcome(s->editor);
        session_frame(s);
    } else {
        return false;
    }
    return true;
}

// --- is so ---

static void same(const struct played *step, const char *is, const char *expected)
{
    if (strcmp(is, expected) != 0) WRONG(step, "it is \"%s\"", is);
}

static void has(const struct played *step, const char *is, const char *part, bool expected)
{
    if ((strstr(is, part) != NULL) != expected) WRONG(step, "it is \"%s\"", is);
}

static void steady(const struct played *step)
{
    const double within = number_in(step, word(step, 1));
    int curves, samples;
    kept_of(step->s, &curves, &samples);
    for (int i = 0; i < curves * samples; i++) {
        const double is = step->s->work.evaluation.curves[i / samples].total[i % samples];
        const double was = kept_total[i / samples][i % samples];
        if (!(fabs(is - was) <= within))
            WRONG(step, "curve %d was %g at %d, is %g", i / samples, was, i % samples, is);
    }
}

/// The first drawn text that has these words in it, or NULL.
static const char *mentioned(struct session *s, const char *words)
{
    EACH_DRAWN(c, s->editor)
    {
        const char *text = drawn_by(s->editor)->text + c->first;
        if (c->kind == DRAW_TEXT && strstr(text, words)) return text;
    }
    return NULL;
}

/// What text and status line tell; returns false if the step is none of this.
static bool tells(const struct played *step)
{
    struct session *s = step->s;
    const char *label = history_label(s->history, history_done(s->history) - 1), *status = said(s->editor);
    if (IS("kept") || IS("undone")) {
        while (IS("undone") && history_label(s->history, history_done(s->history) - 1)) session_key(s, 'Z', MOD_CTRL);
        same(step, session_saved(s), s->kept);
    } else if (IS("once")) {
        const char *changed = session_saved(s);
        if (strcmp(changed, s->kept) == 0) WRONG(step, "%s", "nothing has changed");
        session_key(s, 'Z', MOD_CTRL);
        same(step, session_saved(s), s->kept);
        session_key(s, 'Z', MOD_CTRL | MOD_SHIFT);
        same(step, session_saved(s), changed);
    } else if (IS("steady")) {
        steady(step);
    } else if (IS("saves") || IS("omits")) {
        char text[sizeof step->text];
        for (size_t i = 0; i == 0 || text[i - 1]; i++) text[i] = step->rest[i] == '\'' ? '"' : step->rest[i];
        has(step, session_saved(s), text, IS("saves"));
    } else if (IS("says") || (IS("said") && !*step->rest)) {
        same(step, status, step->rest);
    } else if (IS("said") || IS("error")) {
        has(step, status, step->rest, true);
        if (IS("error") && !said_error(s->editor)) WRONG(step, "\"%s\" is no error", status);
    } else if (IS("label")) {
        same(step, label ? label : "", step->rest);
    } else if (IS("shows") || IS("hides")) {
        const struct draw_command *text = shown_text(s->editor, step->rest);
        if (IS("shows") ? !text || text->clip.w <= 0 : text != NULL)
            WRONG(step, "%s", text ? "it is drawn" : "it is not drawn");
    } else if (IS("mentions") || IS("ignores")) {
        const char *text = mentioned(s, step->rest);
        if ((text != NULL) != IS("mentions")) WRONG(step, "%s", text ? text : "no text does");
    } else if (IS("finds") || IS("lacks")) {
        float xy[2];
        if (find_place(s->editor, word(step, 1), xy, NULL) != IS("finds"))
            WRONG(step, "%s", IS("finds") ? "it is not there" : "it is there");
    } else {
        return false;
    }
    return true;
}

/// NaN: no such member.
static double of_knot(const struct session *s, const struct knot *knot, const char *member)
{
    const struct {
        const char *name;
        double value;
    } members[] = {{"frame", knot->frame},      {"value", knot->value},
                   {"slope", knot->slope},      {"stiffness", knot->stiffness},
                   {"sloped", knot->has_slope}, {"phase", knot->phase},
                   {"posed", knot->has_phase},  {"still", knot->still},
                   {"settles", knot->settles},  {"picked", selection_has(selection_of(s->editor), knot->id)}};
    for (size_t i = 0; i < sizeof members / sizeof *members; i++)
        if (strcmp(members[i].name, member) == 0) return members[i].value;
    return NAN;
}

/// A number of the editor or of what it shows. NaN: no such number.
static double of_editor(struct session *s, const char *name)
{
    struct editor *e = s->editor;
    const struct playback *playback = playback_of(e);
    const struct camera *camera = camera_of(e);
    const struct dialog *dialog = dialog_of(e);
    const struct plotted *plot = plot_of(e);
    const struct pose *pose = posed(e);
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"selected", selected(e)},
                   {"active", active(e)},
                   {"body.x", pose->matrix[0][12]},
                   {"body.y", pose->matrix[0][13]},
                   {"body.z", pose->matrix[0][14]},
                   {"camera.azimuth", camera->azimuth},
                   {"camera.distance", camera->distance},
                   {"camera.elevation", camera->elevation},
                   {"channel", e->inspector->channel},
                   {"choice", dialog->choice},
                   {"chosen", core_chosen_count(&e->core)},
                   {"curves.others", e->curves->cache.other_count},
                   {"dragging", is_dragging(e)},
                   {"dropped", (double)playback->dropped},
                   {"export.keys", e->dialogs->exporting.memory.wish.keys},
                   {"history.saved", history_is_saved(s->history)},
                   {"looping", is_on(e, SWITCH_LOOP)},
                   {"matches", dialog->match_count},
                   {"onion", is_on(e, SWITCH_ONION)},
                   {"open", history_is_open(s->history)},
                   {"playhead", shown_frame(e)},
                   {"playing", playback->playing},
                   {"plot.bottom", plot->value0},
                   {"plot.left", plot->frame0},
                   {"plot.right", plot->frame1},
                   {"plot.top", plot->value1},
                   {"popup", inspector_of(e)->popup.id != 0},
                   {"position", playback->position},
                   {"recent", dialog->recent_count},
                   {"record", is_on(e, SWITCH_RECORD)},
                   {"rig", e->inspector->rig},
                   {"scrolled", sections(e)->offset},
                   {"seconds", is_on(e, SWITCH_SECONDS)},
                   {"sliding", inspector_is_dragging(e->inspector)},
                   {"speed", playback->speed},
                   {"stage.models", editor_stage(e)->model_count},
                   {"stage.tails", e->stage->tail_count},
                   {"steps", (double)history_done(s->history)},
                   {"tip.behind", pose->matrix[24][12] - pose->matrix[0][12]},
                   {"trail", is_on(e, SWITCH_TRAIL)},
                   {"typing", inspector_of(e)->typing != 0},
                   {"wants.frames", editor_wants_frames(e)},
                   {"warnings", warnings_of(e)->count},
                   {"welcoming", is_welcoming(e)}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(numbers[i].name, name) == 0) return numbers[i].value;
    return NAN;
}

/// A member of the document by its path: names and indices with points between them; # is a list's length.
static bool find_saved(struct session *s, const char *path, char text[MOST_TEXT])
{
    char *const saved = text_of_document(s->document);
    json_t *const root = json_loads(saved, 0, NULL), *value = root;
    assert_non_null(root);
    free(saved);
    text[0] = '\0';
    while (value && *path) {
        char name[64];
        const size_t length = strcspn(path, ".");
        snprintf(name, sizeof name, "%.*s", (int)length, path);
        if (name[0] == '#') sprintf(text, "%zu", json_array_size(value));
        value = json_is_array(value) ? json_array_get(value, (size_t)atoi(name)) : json_object_get(value, name);
        path += length + (path[length] == '.');
        if (name[0] == '#') value = NULL;
    }
    if (json_is_number(value)) snprintf(text, MOST_TEXT, "%.17g", json_number_value(value));
    if (json_is_string(value)) snprintf(text, MOST_TEXT, "%s", json_string_value(value));
    if (json_is_boolean(value)) snprintf(text, MOST_TEXT, "%s", json_is_true(value) ? "true" : "false");
    if (json_is_array(value) || json_is_object(value)) snprintf(text, MOST_TEXT, "list");
    json_decref(root);
    return text[0] != '\0';
}

/// What a name of `is` means now, as text; false: nothing has it.
static bool find(struct session *s, const char *name, char text[MOST_TEXT])
{
    // in the order of enum dialog_kind, lookup_kind and event_cursor
    static const char *const dialogs[] = {"none",    "open",    "add", "save-as", "unsaved",
                                          "recover", "changed", "ask", "export"};
    static const char *const lookups[] = {"none", "keys", "palette", "menu"};
    static const char *const looks[] = {[LOOK_WIGGLY] = "wiggly", [LOOK_STIFF] = "stiff", [LOOK_CUBIC] = "cubic"};
    static const char *const cursors[] = {"arrow", "hand", "horizontal", "vertical", "move", "text"};
    struct editor *e = s->editor;
    int model;
    float x, y;
    const int at = active(e), node = bones_selected(&e->core, &model);
    const double number = of_editor(s, name);
    const struct ui *ui = inspector_of(e);
    const struct {
        const char *name, *text;
    } texts[] = {{"active.name", at < 0 ? "none" : s->document->splines[at]->name},
                 {"asked", dialogs[asked(e)]},
                 {"bone", node < 0 ? "" : bones_character(&e->core, model)->gltf.nodes[node].name},
                 {"cursor", cursors[editor_cursor(e)]},
                 {"export.ending", export_formats[e->dialogs->exporting.format].ending},
                 {"export.path", e->dialogs->exporting.memory.path},
                 {"field", ui->text.bytes},
                 {"hint", ui->hint ? ui->hint : "nothing"},
                 {"hovered", hovered(e) ? "a thing" : "nothing"},
                 {"look", looks[look(e)]},
                 {"lookup", lookups[lookup_of(e)->kind]},
                 {"refused", asked_error(e)},
                 {"typed", typed(e)}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (strcmp(name, texts[i].name) == 0) return snprintf(text, MOST_TEXT, "%s", texts[i].text) >= 0;
    if (!isnan(number)) return snprintf(text, MOST_TEXT, "%.17g", number) > 0;
    if (strncmp(name, "y:", 2) == 0)
        return widget_at(e, name + 2, &x, &y) && snprintf(text, MOST_TEXT, "%.9g", (double)y) > 0;
    if (strncmp(name, "curve:", 6) == 0)
        return snprintf(text, MOST_TEXT, "%d", spline_list_shows(&e->core, atoi(name + 6))) > 0;
    return find_saved(s, name, text);
}

double number(struct session *s, const char *name)
{
    char text[MOST_TEXT];
    return find(s, name, text) ? strtod(text, NULL) : NAN;
}

/// The numbers of a name; returns how many there are.
static int numbers_of(const struct played *step, const char *text, double found[MOST_NUMBERS])
{
    struct session *s = step->s;
    char name[64];
    snprintf(name, sizeof name, "%s", text);
    char *member = name + strcspn(name, ".@"), *end;
    const bool samples = *member == '@';
    if (strcmp(name, "part") == 0) return playback_range(&s->editor->core, found), 2;
    found[0] = of_editor(s, name);
    if (!isnan(found[0])) return 1;
    if (*member) *member++ = '\0';
    const int i = document_find_spline(s->document, name);
    if (i < 0) WRONG(step, "there is no %s", name);
    const struct spline *spline = s->document->splines[i];
    if (samples) {
        found[0] = s->work.evaluation.curves[i].total[(int)number_in(step, member) * s->document->substeps];
        return 1;
    }
    if (strcmp(member, "knots") == 0) return (void)(found[0] = spline->knot_count), 1;
    if (strcmp(member, "limits") == 0) {
        for (int high = 0; high < 2; high++) found[high] = spline->parameter[PARAMETER_LOW + high].value;
        return 2;
    }
    const enum parameter parameter = parameter_find(member);
    if (parameter < PARAMETER_COUNT) return (void)(found[0] = spline->parameter[parameter].value), 1;
    const int k = (int)strtol(member, &end, 10);
    if (end > member && *end == '.' && k < spline->knot_count)
        return (void)(found[0] = of_knot(s, &spline->knots[k], end + 1)), 1;
    int count = 0;
    for (; count < spline->knot_count && count < MOST_NUMBERS; count++)
        found[count] = of_knot(s, &spline->knots[count], member);
    return count;
}

/// A number, the one of a name, or what was kept of the step's own name and a number to add.
static double value_of(const struct played *step, const char *of, const char *text)
{
    double found[MOST_NUMBERS];
    for (int i = 0; i < MOST_KEPT && strncmp(text, "kept", 4) == 0; i++)
        if (strcmp(kept_number[i].name, of) == 0)
            return kept_number[i].number + (text[4] ? number_in(step, text + 4) : 0);
    if (!isalpha((unsigned char)*text) || strcmp(text, "inf") == 0) return number_in(step, text);
    if (numbers_of(step, text, found) != 1) WRONG(step, "%s is no number", text);
    return found[0];
}

/// The numbers of the word before the `first` compare with those behind it: [>|<|!] N ... [~E].
static void compare(const struct played *step, int first, const double found[], int count, double within)
{
    const char *of = step->word[first - 1];
    int last = step->count;
    if (*word(step, last - 1) == '~') within = number_in(step, step->word[--last] + 1);
    const char sign = *word(step, first);
    if (sign == '>' || sign == '<' || sign == '!') first++;
    if (last - first != count) WRONG(step, "there are %d numbers", count);
    for (int i = 0; i < count; i++) {
        const double value = value_of(step, of, step->word[first + i]);
        const bool holds = sign == '>'   ? found[i] > value
                           : sign == '<' ? found[i] < value
                           : sign == '!' ? found[i] != value
                                         : fabs(found[i] - value) <= within || found[i] == value;
        if (!holds || isnan(found[i])) WRONG(step, "number %d is %.17g", i, found[i]);
    }
}

/// "is NAME TEXT", or a number, exactly.
static void is(const struct played *step)
{
    char text[MOST_TEXT], *end;
    const char *name = word(step, 1), *expected = behind(step, name);
    const char *found = find(step->s, name, text) ? text : "nothing";
    const double value = strtod(found, &end);
    if (strcmp(found, expected) == 0) return;
    if (end == found || *end || !*expected) WRONG(step, "it is \"%s\"", found);
    compare(step, 2, &value, 1, 0);
}

static void play(struct played *step)
{
    double found[MOST_NUMBERS];
    char *left;
    snprintf(step->words, sizeof step->words, "%s", step->text);
    step->count = 0;
    memset(step->word, 0, sizeof step->word);
    for (char *w = strtok_r(step->words, " ", &left); w; w = strtok_r(NULL, " ", &left)) {
        if (step->count == MOST_WORDS - 1) WRONG(step, "%s", "too many words");
        step->word[step->count++] = w;
    }
    if (step->count == 0) return;
    step->rest = step->text + strcspn(step->text, " ");
    step->rest += strspn(step->rest, " ");
    if (IS("is")) return is(step);
    if (!strokes(step) && !does(step) && !runs(step) && !tells(step))
        compare(step, 1, found, numbers_of(step, step->word[0], found), 1e-9);
}

void hands(struct session *s, const char *steps, ...)
{
    char all[4096];
    struct played step = {.s = s, .all = all};
    va_list list;
    va_start(list, steps);
    const int length = vsnprintf(all, sizeof all, steps, list);
    va_end(list);
    assert_in_range(length, 0, sizeof all - 1);
    if (!s->kept) { // the first steps of the session
        memset(kept_number, 0, sizeof kept_number);
        keep(s);
    }
    for (const char *at = all; *at;) {
        at += strspn(at, " ;");
        const size_t size = strcspn(at, ";");
        assert_true(size < sizeof step.text);
        memcpy(step.text, at, size);
        step.text[size] = '\0';
        at += size;
        play(&step);
    }
}
