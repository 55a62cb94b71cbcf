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

/// The curves of the session that are kept; returns how many there are.
static int curves_of(const struct session *s, const wiggly_curve **curves, int *samples)
{
    const struct evaluation *evaluation = &s->work.evaluation;
    *curves = evaluation->curves;
    *samples = evaluation->samples < MOST_SAMPLES ? evaluation->samples : MOST_SAMPLES;
    return s->document->spline_count < MOST_CURVES ? s->document->spline_count : MOST_CURVES;
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

static void press(const struct played *step, int i, int clicks)
{
    if (i < step->count) point(step, i);
    session_press(step->s, BUTTON_LEFT, clicks);
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
    press(step, 1, 1);
    snprintf(target, sizeof target, "%s,%s", word(step, 1), word(step, 2));
    if (!find_place(step->s->editor, target, xy, &why)) WRONG(step, "%s", why.text);
    session_move(step->s, xy[0] + 3, xy[1]);
    session_move(step->s, xy[0], xy[1]);
    session_frame(step->s);
}

static void keep(struct session *s)
{
    const wiggly_curve *curves;
    int samples;
    s->kept = session_saved(s);
    for (int i = curves_of(s, &curves, &samples) - 1; i >= 0; i--)
        memcpy(kept_total[i], curves[i].total, (size_t)samples * sizeof(double));
}

/// Returns false if the step's first word is none of these.
static bool does(const struct played *step)
{
    struct session *s = step->s;
    const char *verb = step->word[0], *mods = step->rest;
    const bool boxes = strcmp(verb, "box") == 0, carries = strcmp(verb, "carry") == 0;
    if (strcmp(verb, "point") == 0 || strcmp(verb, "hover") == 0) {
        point(step, 1);
        if (*verb == 'h') session_frame(s);
    } else if (strcmp(verb, "press") == 0) {
        press(step, 1, 1);
    } else if (strcmp(verb, "release") == 0) {
        session_release(s, BUTTON_LEFT);
    } else if (strcmp(verb, "click") == 0 || strcmp(verb, "again") == 0) {
        press(step, 1, *verb == 'a' ? 2 : 1);
        session_release(s, BUTTON_LEFT);
    } else if (strcmp(verb, "drag") == 0) {
        drag(step, 1);
    } else if (strcmp(verb, "pull") == 0 || carries) {
        word(step, 3);
        point(step, 1);
        session_press(s, BUTTON_LEFT, 1);
        drag(step, 2);
        if (carries) session_release(s, BUTTON_LEFT);
    } else if (boxes) {
        point(step, 1);
        session_press(s, BUTTON_LEFT, 1);
        point(step, 2);
        session_frame(s);
        session_release(s, BUTTON_LEFT);
    } else if (strcmp(verb, "with") == 0) {
        s->mods = modifiers(&mods);
    } else if (strcmp(verb, "key") == 0) {
        keys(step);
    } else if (strcmp(verb, "hold") == 0 || strcmp(verb, "let") == 0) {
        session_hold(s, key_of(step, word(step, 1)), *verb == 'h' ? ACTION_PRESS : ACTION_RELEASE);
    } else if (strcmp(verb, "type") == 0) {
        session_type(s, step->rest);
    } else if (strcmp(verb, "paste") == 0) {
        paste(s, step->rest);
    } else if (strcmp(verb, "enter") == 0) {
        point(step, 1);
        session_click_here(s, 2);
        session_type(s, word(step, 2));
        session_key(s, KEY_ENTER, 0);
    } else if (strcmp(verb, "slide") == 0) {
        slide(step);
    } else if (strcmp(verb, "wheel") == 0) {
        session_wheel(s, (float)number(step, word(step, 1)));
    } else if (strcmp(verb, "wait") == 0) {
        for (int i = (int)number(step, word(step, 1)); i > 0; i--) session_frame(s);
    } else if (strcmp(verb, "seek") == 0) {
        seek(s->editor, number(step, word(step, 1)));
        session_frame(s);
    } else if (strcmp(verb, "pass") == 0) {
        editor_advance(s->editor, number(step, word(step, 1)));
    } else if (strcmp(verb, "keep") == 0) {
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

static void finds(const struct played *step, bool expected)
{
    float xy[2];
    if (find_place(step->s->editor, word(step, 1), xy, NULL) != expected)
        WRONG(step, "%s", expected ? "it is not there" : "it is there");
}

static void steady(const struct played *step)
{
    const double within = number(step, word(step, 1));
    const wiggly_curve *curves;
    int samples;
    for (int i = curves_of(step->s, &curves, &samples) - 1; i >= 0; i--) {
        for (int k = 0; k < samples; k++) {
            if (!(fabs(curves[i].total[k] - kept_total[i][k]) <= within))
                WRONG(step, "curve %d is %g at %d, %g before", i, curves[i].total[k], k, kept_total[i][k]);
        }
    }
}

/// The same for text; returns false if the step's first word is none of these.
static bool tells(const struct played *step)
{
    struct session *s = step->s;
    const char *verb = step->word[0], *label = history_undo_label(s->history);
    if (strcmp(verb, "kept") == 0) {
        same(step, session_saved(s), s->kept);
    } else if (strcmp(verb, "once") == 0) {
        const char *changed = session_saved(s);
        if (strcmp(changed, s->kept) == 0) WRONG(step, "%s", "nothing has changed");
        session_key(s, 'Z', MOD_CTRL);
        same(step, session_saved(s), s->kept);
        session_key(s, 'Y', MOD_CTRL);
        same(step, session_saved(s), changed);
    } else if (strcmp(verb, "steady") == 0) {
        steady(step);
    } else if (strcmp(verb, "saves") == 0 || strcmp(verb, "omits") == 0) {
        has(step, session_saved(s), step->rest, *verb == 's');
    } else if (strcmp(verb, "said") == 0 && *step->rest) {
        has(step, said(s->editor), step->rest, true);
    } else if (strcmp(verb, "said") == 0 || strcmp(verb, "says") == 0) {
        same(step, said(s->editor), step->rest);
    } else if (strcmp(verb, "error") == 0) {
        has(step, said(s->editor), step->rest, true);
        if (!said_error(s->editor)) WRONG(step, "\"%s\" is no error", said(s->editor));
    } else if (strcmp(verb, "label") == 0) {
        same(step, label ? label : "", step->rest);
    } else if (strcmp(verb, "shows") == 0 || strcmp(verb, "hides") == 0) {
        const struct draw_command *text = shown_text(s->editor, step->rest);
        if ((text && text->clip.w > 0) != (*verb == 's')) WRONG(step, "%s", text ? "it is drawn" : "it is not drawn");
    } else if (strcmp(verb, "finds") == 0 || strcmp(verb, "lacks") == 0) {
        finds(step, *verb == 'f');
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
    if (!does(step) && !tells(step)) is_so(step);
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
