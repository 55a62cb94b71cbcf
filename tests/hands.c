/// Plays the steps of hands.h.
#include "hands.h"
#include "scene/document.h"
#include "shown.h"

enum { MOST_WORDS = 40, MOST_NUMBERS = 64, MOST_SAMPLES = 512, MOST_CURVES = 3 };

/// The curves at the last `keep`.
static double kept_total[MOST_CURVES][MOST_SAMPLES];

/// One step, while it is played.
struct played {
    struct session *s;
    const char *all;        ///< the steps
    char text[512];         ///< the step
    char words[512];        ///< what word[] points into
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

static double number(const struct played *step, const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    if (end == text || *end) WRONG(step, "%s is no number", text);
    return value;
}

// --- does ---

/// Where a target of replays is, or a widget of the inspector, whose name may have _ for a space.
static bool find_place(struct editor *e, const char *target, float xy[2], struct error *why)
{
    char name[64];
    if (strchr(target, '(')) return editor_target(e, target, &xy[0], &xy[1], why);
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
    return (float)number(step, text);
}

/// By the words from the i-th on.
static void drag(const struct played *step, int i)
{
    session_drag(step->s, way(step, word(step, i)), way(step, word(step, i + 1)),
                 step->word[i + 2] ? (int)number(step, step->word[i + 2]) : 4);
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
        const int times = star ? atoi(step->word[i]) : 1;
        const unsigned mods = modifiers(&name);
        for (int n = 0; n < times; n++) session_key(step->s, key_of(step, name), mods);
    }
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
    } else if (IS("slide")) {
        slide(step);
    } else if (IS("with")) {
        s->mods = modifiers(&mods);
    } else if (IS("key")) {
        keys(step);
    } else if (IS("hold") || IS("let")) {
        session_hold(s, key_of(step, word(step, 1)), IS("hold") ? ACTION_PRESS : ACTION_RELEASE);
    } else if (IS("type")) {
        session_type(s, step->rest);
    } else if (IS("paste")) {
        paste(s, step->rest);
    } else if (IS("enter")) {
        point(step, 1);
        session_click_here(s, 2);
        session_type(s, word(step, 2));
        session_key(s, KEY_ENTER, 0);
    } else if (IS("wheel")) {
        session_wheel(s, (float)number(step, word(step, 1)));
    } else if (IS("wait")) {
        for (int i = (int)number(step, word(step, 1)); i > 0; i--) session_frame(s);
    } else if (IS("pass")) {
        editor_advance(s->editor, number(step, word(step, 1)));
    } else if (IS("seek")) {
        seek(s->editor, number(step, word(step, 1)));
        session_frame(s);
    } else if (IS("keep")) {
        keep(s);
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
    const double within = number(step, word(step, 1));
    int curves, samples;
    kept_of(step->s, &curves, &samples);
    for (int i = 0; i < curves * samples; i++) {
        const double is = step->s->work.evaluation.curves[i / samples].total[i % samples];
        const double was = kept_total[i / samples][i % samples];
        if (!(fabs(is - was) <= within))
            WRONG(step, "curve %d was %g at %d, is %g", i / samples, was, i % samples, is);
    }
}

/// What text and status line tell; returns false if the step is none of this.
static bool tells(const struct played *step)
{
    struct session *s = step->s;
    const char *label = history_undo_label(s->history), *status = said(s->editor);
    if (IS("kept")) {
        same(step, session_saved(s), s->kept);
    } else if (IS("once")) {
        const char *changed = session_saved(s);
        if (strcmp(changed, s->kept) == 0) WRONG(step, "%s", "nothing has changed");
        session_key(s, 'Z', MOD_CTRL);
        same(step, session_saved(s), s->kept);
        session_key(s, 'Y', MOD_CTRL);
        same(step, session_saved(s), changed);
    } else if (IS("steady")) {
        steady(step);
    } else if (IS("saves") || IS("omits")) {
        has(step, session_saved(s), step->rest, IS("saves"));
    } else if (IS("says") || (IS("said") && !*step->rest)) {
        same(step, status, step->rest);
    } else if (IS("said") || IS("error")) {
        has(step, status, step->rest, true);
        if (IS("error") && !said_error(s->editor)) WRONG(step, "\"%s\" is no error", status);
    } else if (IS("label")) {
        same(step, label ? label : "", step->rest);
    } else if (IS("shows") || IS("hides")) {
        const struct draw_command *text = shown_text(s->editor, step->rest);
        if ((text && text->clip.w > 0) != IS("shows")) WRONG(step, "%s", text ? "it is drawn" : "it is not drawn");
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

/// NaN: no such number.
static double of_editor(const struct session *s, const char *name)
{
    struct editor *e = s->editor;
    const struct playback *playback = playback_of(e);
    const struct {
        const char *name;
        double value;
    } numbers[] = {{"selected", selected(e)},
                   {"active", active(e)},
                   {"playhead", shown_frame(e)},
                   {"playing", playback->playing},
                   {"speed", playback->speed},
                   {"dropped", (double)playback->dropped},
                   {"looping", is_on(e, SWITCH_LOOP)},
                   {"seconds", is_on(e, SWITCH_SECONDS)},
                   {"dragging", is_dragging(e)},
                   {"open", history_is_open(s->history)},
                   {"steps", (double)history_done(s->history)},
                   {"asked", asked(e)},
                   {"warnings", warnings_of(e)->count},
                   {"splines", s->document->spline_count},
                   {"substeps", s->document->substeps},
                   {"first", s->document->first_frame},
                   {"last", s->document->last_frame}};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (strcmp(numbers[i].name, name) == 0) return numbers[i].value;
    return NAN;
}

/// The numbers of a name; returns how many there are.
static int numbers_of(const struct played *step, const char *text, double found[MOST_NUMBERS])
{
    const struct session *s = step->s;
    char name[64];
    snprintf(name, sizeof name, "%s", text);
    char *member = name + strcspn(name, ".@"), *end;
    const bool samples = *member == '@';
    if (!*member) {
        if (strcmp(name, "part") == 0) return playback_range(&s->editor->core, found), 2;
        found[0] = of_editor(s, name);
        return isnan(found[0]) ? 0 : 1;
    }
    *member++ = '\0';
    const int i = document_find_spline(s->document, name);
    if (i < 0) WRONG(step, "there is no spline %s", name);
    const struct spline *spline = s->document->splines[i];
    if (samples) {
        found[0] = s->work.evaluation.curves[i].total[(int)number(step, member) * s->document->substeps];
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

/// A number, or the one of a name.
static double value_of(const struct played *step, const char *text)
{
    double found[MOST_NUMBERS];
    if (!isalpha((unsigned char)*text) || strcmp(text, "inf") == 0) return number(step, text);
    if (numbers_of(step, text, found) != 1) WRONG(step, "%s is no number", text);
    return found[0];
}

static void is_so(const struct played *step)
{
    double found[MOST_NUMBERS], within = 1e-9;
    const int count = numbers_of(step, step->word[0], found);
    int last = step->count, first = 1;
    if (*word(step, last - 1) == '~') within = number(step, step->word[--last] + 1);
    const char sign = *word(step, 1);
    if (sign == '>' || sign == '<' || sign == '!') first = 2;
    if (last - first != count) WRONG(step, "there are %d numbers", count);
    for (int i = 0; i < count; i++) {
        const double value = value_of(step, step->word[first + i]);
        const bool holds = sign == '>'   ? found[i] > value
                           : sign == '<' ? found[i] < value
                           : sign == '!' ? found[i] != value
                                         : fabs(found[i] - value) <= within || found[i] == value;
        if (!holds) WRONG(step, "number %d is %.17g", i, found[i]);
    }
}

static void play(struct played *step)
{
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
    if (!strokes(step) && !does(step) && !tells(step)) is_so(step);
}

void hands(struct session *s, const char *steps, ...)
{
    char all[4096];
    struct played step = {.s = s, .all = all};
    va_list list;
    va_start(list, steps);
    const int length = vsnprintf(all, sizeof all, steps, list);
    va_end(list);
    assert_in_range(length, 1, sizeof all - 1);
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
