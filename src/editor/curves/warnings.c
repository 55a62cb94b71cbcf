/// Warnings on the curves: their marks and fixes.
#include "scene/warnings.h"
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/curves/state.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

/// Other curves, and during a drag the active one too, warn only when they swing far beyond their knots. The other warnings would change at
/// every step of a drag.
void warnings_update(struct curves *curves, const struct core *core)
{
    struct warnings *warnings = &curves->warnings;
    const struct spline *spline = spline_list_seen(core);
    const struct evaluation *evaluation = core->evaluation;
    const struct document *document = core->document;
    const bool solved = evaluation && evaluation->samples == document_samples(document), drags = core->drag.owner;
    const uint64_t state[] = {history_revision(core->history),
                              (uint64_t)(core->active + 1),
                              (uint64_t)core->look,
                              solved,
                              solved ? evaluation->revision : 0,
                              drags,
                              curves->cache.key};
    const uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    if (key == curves->warnings_key) return;
    warnings->count = 0;
    curves->warnings_key = key;
    if (!solved) return;
    memset(curves->fixes, 0, sizeof curves->fixes);
    if (spline && drags) warnings_add_far(document, evaluation, core->active, warnings);
    if (spline && !drags) warnings_add(document, evaluation, core->active, warnings);
    for (int i = 0; i < curves->cache.other_count; i++)
        warnings_add_far(document, evaluation, curves_other(curves, document, i), warnings);
}

// The remedies. Each edits any document and describes itself in a text that fits after "Click to" and "Done:".

static bool set(struct document *document, const struct warning *warning, enum parameter parameter, double value,
                struct error *error)
{
    const struct param param = param_number(value);
    return edit_parameter(document, warning->spline, parameter, &param, error);
}

static bool raise_calm(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                       struct error *error)
{
    snprintf(text, FIX_TEXT, "raise calm to 1");
    return set(document, warning, PARAMETER_CALM, 1, error);
}

static bool set_limits(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                       struct error *error)
{
    snprintf(text, FIX_TEXT, "set limits from %.6g to %.6g", warning->low, warning->high);
    return set(document, warning, PARAMETER_LOW, warning->low, error) &&
           set(document, warning, PARAMETER_HIGH, warning->high, error);
}

/// Adds a pose, or outside complex mode a plain knot.
static bool add_knot(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                     struct error *error)
{
    const bool is_pose = spline_mode(document->splines[warning->spline]) == WIGGLY_COMPLEX;
    const struct knot knot = {.frame = warning->frame,
                              .value = warning->remedy,
                              .has_phase = is_pose,
                              .phase = is_pose ? warning->phase : 0,
                              .stiffness = KNOT_DEFAULT_STIFFNESS};
    snprintf(text, FIX_TEXT, "add a %s at frame %.6g", is_pose ? "pose" : "knot", warning->frame);
    return edit_knot_insert(document, warning->spline, &knot, error);
}

/// Keeps the motion.
static bool add_substeps(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                         struct error *error)
{
    snprintf(text, FIX_TEXT, "use %.0f substeps per frame", warning->remedy);
    return warning->remedy <= SCENE_MAX_SUBSTEPS && edit_substeps(document, (int)warning->remedy, error);
}

static bool lower_frequency(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                            struct error *error)
{
    const double now = document->splines[warning->spline]->parameter[PARAMETER_FREQUENCY].value;
    const double lower = core_round(0.99 * now * warning->limit / warning->amount, 0.01);
    snprintf(text, FIX_TEXT, "lower the frequency to %.3g Hz", lower);
    return set(document, warning, PARAMETER_FREQUENCY, lower, error);
}

static bool narrow_bandwidth(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                             struct error *error)
{
    snprintf(text, FIX_TEXT, "narrow the bandwidth to %.3g", warning->remedy);
    return set(document, warning, PARAMETER_BANDWIDTH, warning->remedy, error);
}

/// Frees the slope or the phase of the knot at a frame.
static bool free_knot(struct document *document, const struct warning *warning, double frame, bool slope,
                      struct error *error)
{
    const struct spline *spline = document->splines[warning->spline];
    const int k = spline_find_knot(document, spline, document_sample(document, frame));
    if (k < 0) return false;
    struct knot knot = spline->knots[k];
    if (slope) knot.has_slope = false;
    if (!slope) knot.has_phase = false, knot.phase = 0;
    return edit_knot_set(document, warning->spline, &knot, error);
}

static bool free_later(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                       struct error *error)
{
    snprintf(text, FIX_TEXT, "free the phase at frame %.6g", warning->to);
    return free_knot(document, warning, warning->to, false, error);
}

static bool free_earlier(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                         struct error *error)
{
    snprintf(text, FIX_TEXT, "free the phase at frame %.6g", warning->from);
    return free_knot(document, warning, warning->from, false, error);
}

static bool free_both(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                      struct error *error)
{
    const bool good = free_later(document, warning, text, error) && free_earlier(document, warning, text, error);
    snprintf(text, FIX_TEXT, "free the phases at frames %.6g and %.6g", warning->from, warning->to);
    return good;
}

static bool free_all(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                     struct error *error)
{
    bool good = true;
    for (int k = 0; k < document->splines[warning->spline]->knot_count && good; k++)
        good = free_knot(document, warning, document->splines[warning->spline]->knots[k].frame, false, error);
    snprintf(text, FIX_TEXT, "turn the spline's poses into plain knots");
    return good;
}

static bool drop_slope(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                       struct error *error)
{
    snprintf(text, FIX_TEXT, "switch off the slope at frame %.6g", warning->frame);
    return free_knot(document, warning, warning->frame, true, error);
}

static bool drop_wind_up(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                         struct error *error)
{
    snprintf(text, FIX_TEXT, "set the wind-up to 0");
    return set(document, warning, PARAMETER_WIND_UP, 0, error);
}

static bool lengthen_wind_up(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                             struct error *error)
{
    snprintf(text, FIX_TEXT, "lengthen the wind-up to %.3g periods", warning->remedy);
    return set(document, warning, PARAMETER_WIND_UP, warning->remedy, error);
}

static bool unsettle_all(struct document *document, const struct warning *warning, char text[FIX_TEXT],
                         struct error *error)
{
    snprintf(text, FIX_TEXT, "let its knots be plain ones");
    return edit_spline_settles(document, warning->spline, false, error);
}

/// Remedies for each kind of warning, the gentlest first. A later one must beat those before it, and doing nothing, by a factor.
static const struct cure {
    const char *label; ///< of the undo step
    remedy *remedies[4];
    double worth;
} cures[] = {
    [WARNING_FAR] = {"Tame swing", {raise_calm, set_limits, add_knot}, 1},
    [WARNING_RATE] = {"Add substeps", {add_substeps, lower_frequency}, 1},
    [WARNING_DRIFT] = {"Narrow bandwidth", {narrow_bandwidth}, 1},
    [WARNING_FORCED] = {"Free the phase", {free_later, free_earlier, free_both}, 1.25},
    [WARNING_SLOPE] = {"Slope off", {drop_slope}, 1},
    [WARNING_PHASE] = {"Free the phase", {free_all}, 1},
    [WARNING_WIND_UP] = {"Wind-up off", {drop_wind_up}, 1},
    [WARNING_SUDDEN] = {"Lengthen wind-up", {lengthen_wind_up}, 1},
    [WARNING_SETTLES] = {"Settle off", {unsettle_all}, 1},
};

static bool has_choice(const struct warning *warning) { return cures[warning->kind].remedies[1] != NULL; }

/// What is left of a problem after a remedy, tried in a copy; infinity if it cannot apply. A kind's only remedy counts as enough.
/// `trial` keeps earlier results, so only what differs is solved.
static double left_with(const struct core *core, const struct warning *warning, struct fix *fix,
                        struct evaluation *trial)
{
    struct error error;
    struct document *document = document_copy(core->document);
    double left = INFINITY;
    if (fix->apply(document, warning, fix->text, &error)) {
        left = 0;
        if (has_choice(warning)) {
            evaluation_update(trial, document, false);
            left = warning_left(warning, document, trial);
        }
    }
    document_destroy(document);
    return left;
}

/// The first remedy if it suffices, else the best.
static struct fix choose(const struct core *core, const struct warning *warning)
{
    const struct cure *cure = &cures[warning->kind];
    struct evaluation trial = {.solver = core->evaluation->solver, .models = core->evaluation->models};
    struct fix best = {.is_chosen = true};
    double least = has_choice(warning) ? warning_left(warning, core->document, core->evaluation) : INFINITY;
    for (int i = 0; cure->remedies[i] && (i != 1 || least > 1); i++) {
        struct fix fix = {true, cure->remedies[i], ""};
        const double left = left_with(core, warning, &fix, &trial);
        if (left * cure->worth >= least) continue;
        best = fix;
        least = left;
    }
    evaluation_free(&trial);
    return best;
}

/// The chosen fix, cached.
static const struct fix *fix_of(struct curves *curves, const struct core *core, int index)
{
    struct fix *fix = &curves->fixes[index];
    if (!fix->is_chosen) *fix = choose(core, &curves->warnings.list[index]);
    return fix;
}

static const char NO_REMEDY[] = "No fix helps here. Move the knots, or change the frequency.";

/// Fixes a warning in one undo step.
static void press_warning(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    const struct warning warning = curves->warnings.list[hover->handle];
    struct fix fix = *fix_of(curves, core, hover->handle);
    (void)event;
    char text[FIX_TEXT + 8];
    core_activate(core, warning.spline);
    if (!core_active_spline(core) || !core_begin(core, cures[warning.kind].label, 0)) return;
    const bool good = fix.apply && fix.apply(core->document, &warning, fix.text, &core->error);
    snprintf(text, sizeof text, "Done: %s.", fix.text);
    core_end(core, good);
    if (good || !fix.apply) core_message(core, false, "%s", good ? text : NO_REMEDY);
}

void curves_remedy_first(struct curves *curves, struct core *core, int unused)
{
    (void)unused;
    warnings_update(curves, core);
    if (curves->warnings.count > 0) {
        press_warning(curves, core, &(struct hover){.handle = 0}, NULL);
    } else {
        core_message(core, false, "This spline has no warnings.");
    }
}

static const float SIZE = 7, LIFT = 16,
                   EDGE = 12; ///< pixels: half a marker; distance above its point; distance from the plot's edge

bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2])
{
    const struct rect plot = core->layout.plot;
    xy[0] = plot.x + EDGE;
    xy[1] = plot.y + EDGE;
    if (warning->kind == WARNING_RATE) return true;
    xy[0] = curves_x(curves, core, warning->frame);
    xy[1] = fminf(fmaxf(curves_y_of(curves, core, warning->spline, warning->value) - LIFT, plot.y + EDGE),
                  plot.y + plot.h - EDGE);
    return xy[0] >= plot.x && xy[0] <= plot.x + plot.w;
}

static bool find_warning(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct curves *curves = room;
    const double number = target->number[0];
    bool there = number >= 0 && number < curves->warnings.count;
    return there && warning_place(curves, core, &curves->warnings.list[(int)number], xy);
}

const struct thing thing_warning = {.cursor = CURSOR_HAND,
                                    .hint = "Click to fix; Ctrl+Z undoes it",
                                    .press = press_warning,
                                    .name = "warning",
                                    .numbers = 1,
                                    .find = find_warning,
                                    .missing = "that warning is not to be seen"};

/// The warning under the pointer, or -1.
static int hovered_warning(const struct curves *curves, const struct core *core)
{
    const int index = core->hover.handle;
    return core->hover.thing == &thing_warning && index < curves->warnings.count ? index : -1;
}

static void show_marker(struct drawlist *list, const float xy[2], bool hovered)
{
    const float x = xy[0], y = xy[1], r = hovered ? SIZE + 1.5f : SIZE;
    const float corners[] = {x, y - r, x + r, y + 0.8f * r, x - r, y + 0.8f * r};
    drawlist_convex(list, corners, 3, theme()->warning);
    drawlist_rect(list, (struct rect){x - 0.75f, y - 0.4f * r, 1.5f, 0.6f * r}, theme()->panel);
    drawlist_rect(list, (struct rect){x - 0.75f, y + 0.38f * r, 1.5f, 1.5f}, theme()->panel);
}

void warnings_show(const struct curves *curves, struct core *core)
{
    const int hovered = hovered_warning(curves, core);
    for (int i = 0; i < curves->warnings.count; i++) {
        float xy[2];
        if (warning_place(curves, core, &curves->warnings.list[i], xy)) show_marker(&core->list, xy, i == hovered);
    }
}

void warnings_show_words(struct curves *curves, struct core *core)
{
    enum { PAD = 10, LINE = 18 };
    const int index = hovered_warning(curves, core);
    float xy[2];
    if (index < 0 || !warning_place(curves, core, &curves->warnings.list[index], xy)) return;
    char what[WARNING_SENTENCE], click[FIX_TEXT + 16] = "";
    warning_say(&curves->warnings.list[index], what);
    if (!core->drag.owner) {
        const struct fix *fix = fix_of(curves, core, index);
        snprintf(click, sizeof click, fix->apply ? "Click to %s." : NO_REMEDY, fix->text);
    }
    const struct rect panel = core->layout.curves;
    float width =
        fmaxf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, what), font_width(FONT_LABEL, THEME_TEXT_NORMAL, click));
    float w = fminf(width + 2 * PAD, panel.w - 16), h = 2 * LINE + PAD;
    float x = fminf(fmaxf(xy[0] - w / 2, panel.x + 8), panel.x + panel.w - 8 - w);
    float y = xy[1] + 14 + h < panel.y + panel.h ? xy[1] + 14 : xy[1] - 14 - h;
    struct rect box = {roundf(x), roundf(y), w, h};
    drawlist_rounded(&core->list, box, 5, theme()->raised);
    drawlist_rounded_line(&core->list, box, 5, 1, theme_fade(theme()->warning, 0.6f));
    drawlist_text_fit(&core->list, box.x + PAD, box.y + LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, what);
    drawlist_text_fit(&core->list, box.x + PAD, box.y + 2 * LINE, w - 2 * PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->warning, click);
}
