/// Names for places on the screen, for replays; they survive a new layout: "knot(sway,2)", "tail(tail,0.9)".
#include "editor/core/bones.h"
#include "editor/curves/curves.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NUMBERS = 2, MAX_NAME = 256 };

/// A target taken apart: kind(name,number,…); the name may hold anything, the numbers are what follows the last
/// commas.
struct target {
    char name[MAX_NAME];
    double number[MAX_NUMBERS];
};

struct target_place {
    struct editor *editor; ///< as it was after all: inspector_target() lays its widgets out to find one
    const struct target *target;
    float xy[2];
};

typedef bool find_place(struct target_place *place, struct error *error);

static bool in_plot(struct target_place *place, double frame, double value, struct error *error)
{
    place->xy[0] = curves_x(place->editor->curves, &place->editor->core, frame);
    place->xy[1] = curves_y(place->editor->curves, &place->editor->core, value);
    const struct rect *plot = &place->editor->core.layout.plot;
    bool inside = place->xy[0] >= plot->x && place->xy[1] >= plot->y && place->xy[0] <= plot->x + plot->w &&
                  place->xy[1] <= plot->y + plot->h;
    return inside ||
           fail(error, ERROR_INPUT, "frame %g, value %g is not in the visible part of the curves", frame, value);
}

static bool spline_named(const struct target_place *place, int *spline, struct error *error)
{
    *spline = document_find_spline(place->editor->core.document, place->target->name);
    return *spline >= 0 || fail(error, ERROR_INPUT, "there is no spline \"%s\"", place->target->name);
}

static bool knot_named(struct target_place *place, const struct knot **knot, struct error *error)
{
    int spline;
    if (!spline_named(place, &spline, error)) return false;
    double k = place->target->number[0];
    const struct spline *owner = place->editor->core.document->splines[spline];
    if (!(k >= 0 && k < owner->knot_count)) {
        return fail(error, ERROR_INPUT, "the spline \"%s\" has %d knots, no knot %g", owner->name, owner->knot_count,
                    k);
    }
    *knot = &owner->knots[(int)k];
    return true;
}

static bool find_knot(struct target_place *place, struct error *error)
{
    const struct document *document = place->editor->core.document;
    const struct knot *knot;
    if (!knot_named(place, &knot, error)) return false;
    return in_plot(place, document_frame(document, document_sample(document, knot->frame)), knot->value, error);
}

/// A knot's mark on the dope sheet: mark(sway,2).
static bool find_mark(struct target_place *place, struct error *error)
{
    const struct document *document = place->editor->core.document;
    const struct knot *knot;
    if (!knot_named(place, &knot, error)) return false;
    const int spline = document_find_spline(document, place->target->name);
    return curves_mark_point(place->editor->curves, &place->editor->core, spline, (int)place->target->number[0],
                             place->xy) ||
           fail(error, ERROR_INPUT, "the dope sheet does not show that knot of \"%s\"", place->target->name);
}

/// The end of a knot's slope handle: handle(sway,2,1), 0 before and 1 after the knot.
static bool find_handle(struct target_place *place, struct error *error)
{
    const struct knot *knot;
    if (!knot_named(place, &knot, error)) return false;
    if (!knot->has_slope) return fail(error, ERROR_INPUT, "that knot of \"%s\" has no slope", place->target->name);
    curves_handle(place->editor->curves, &place->editor->core, knot, place->target->number[1] > 0, place->xy);
    return true;
}

static bool find_curve(struct target_place *place, struct error *error)
{
    int spline;
    if (!spline_named(place, &spline, error)) return false;
    return in_plot(place, place->target->number[0], place->target->number[1], error);
}

/// A handle of the box round the selected knots: box(1,0) is the middle of its right edge, box(-1,-1) the upper left corner.
static bool find_box(struct target_place *place, struct error *error)
{
    const int column = (int)place->target->number[0], row = (int)place->target->number[1];
    return curves_box_point(place->editor->curves, &place->editor->core, column, row, place->xy) ||
           fail(error, ERROR_INPUT, "the selected knots have no such handle");
}

static bool find_warning(struct target_place *place, struct error *error)
{
    double number = place->target->number[0];
    return curves_warning(place->editor->curves, &place->editor->core, number, place->xy) ||
           fail(error, ERROR_INPUT, "no warning %g is to be seen", number);
}

static bool find_ruler(struct target_place *place, struct error *error)
{
    const struct rect *ruler = &place->editor->core.layout.ruler;
    place->xy[0] = curves_x(place->editor->curves, &place->editor->core, place->target->number[0]);
    place->xy[1] = ruler->y + ruler->h / 2;
    return rect_contains(*ruler, place->xy[0], place->xy[1]) ||
           fail(error, ERROR_INPUT, "frame %g is not on the visible part of the ruler", place->target->number[0]);
}

static bool find_stage(struct target_place *place, struct error *error)
{
    (void)error;
    const struct rect *stage = &place->editor->core.layout.stage;
    place->xy[0] = stage->x + stage->w * (float)place->target->number[0];
    place->xy[1] = stage->y + stage->h * (float)place->target->number[1];
    return true;
}

/// From where the pointer is, in heights of the stage: pointer(0.1,0).
static bool find_pointer(struct target_place *place, struct error *error)
{
    (void)error;
    const struct core *core = &place->editor->core;
    place->xy[0] = core->pointer_x + core->layout.stage.h * (float)place->target->number[0];
    place->xy[1] = core->pointer_y + core->layout.stage.h * (float)place->target->number[1];
    return true;
}

/// The rig of a kind that has the target's name, and which of its kind it is; NULL where there is none. A character without a
/// name goes by its model.
static const struct rig *rig_named(const struct target_place *place, enum rig_kind kind, int *n)
{
    const struct document *document = place->editor->core.document;
    int r = document_next_rig(document, kind, 0);
    for (*n = 0; r >= 0; (*n)++, r = document_next_rig(document, kind, r + 1)) {
        const struct rig *rig = document->rigs[r];
        if (strcmp(rig_title(rig), place->target->name) == 0) return rig;
    }
    return NULL;
}

/// A place along a row of joints: 0 is the first, 1 the tip.
static bool find_along(struct target_place *place, enum rig_kind kind, const char *word, struct error *error)
{
    int n;
    const struct rig *rig = rig_named(place, kind, &n);
    if (rig) {
        const int index = document_find_rig_id(place->editor->core.document, rig->id),
                  joints = bones_joints(&place->editor->core, index);
        double along = fmin(fmax(place->target->number[0], 0), 1) * joints;
        int joint = (int)fmin(floor(along), joints - 1);
        if (stage_project(place->editor->stage, &place->editor->core, index, joint, along - joint, place->xy))
            return true;
    }
    return fail(error, ERROR_INPUT, "there is no %s \"%s\" to be seen", word, place->target->name);
}

static bool find_tail(struct target_place *place, struct error *error)
{
    return find_along(place, RIG_TAIL, "tail", error);
}

static bool find_chain(struct target_place *place, struct error *error)
{
    return find_along(place, RIG_CHAIN, "chain", error);
}

/// The name of a bone on a character: all of the target's, or what is behind the character's own name and a slash. NULL: another one's.
static const char *bone_name(const struct target_place *place, const struct rig *character, bool whole)
{
    const char *name = place->target->name, *title = rig_title(character);
    const size_t length = strlen(title);
    if (whole) return name;
    return strncmp(name, title, length) == 0 && name[length] == '/' ? name + length + 1 : NULL;
}

/// A bone of the imported characters: bone(tail_1), the first that there is, or bone(dog 2/tail_1).
static bool find_bone(struct target_place *place, struct error *error)
{
    const struct document *document = place->editor->core.document;
    for (int whole = 1; whole >= 0; whole--) {
        for (int r = document_next_rig(document, RIG_MODEL, 0); r >= 0;
             r = document_next_rig(document, RIG_MODEL, r + 1)) {
            const struct imported *shown = bones_character(&place->editor->core, r);
            const char *name = bone_name(place, document->rigs[r], whole);
            const int node = shown && name ? gltf_find_node(&shown->gltf, name) : -1;
            if (node >= 0 && stage_bone_point(place->editor->stage, &place->editor->core, r, node, place->xy))
                return true;
        }
    }
    return fail(error, ERROR_INPUT, "there is no bone \"%s\" to be seen", place->target->name);
}

static bool find_body(struct target_place *place, struct error *error)
{
    int n;
    struct editor *editor = place->editor;
    bool shown = rig_named(place, RIG_TAIL, &n) && n < document_count_rigs(editor->core.document, RIG_TAIL);
    return (shown && stage_body_point(editor->stage, &editor->core, n, place->xy)) ||
           fail(error, ERROR_INPUT, "there is no body of a tail \"%s\" to be seen", place->target->name);
}

/// A point of a character's surface: character(up,0.5,0.8), where it is now. u goes across and v up the box of the character
/// at rest, seen from the front.
static bool find_character(struct target_place *place, struct error *error)
{
    int n;
    bool known = rig_named(place, RIG_CHARACTER, &n);
    return (known && stage_character_point(place->editor->stage, n, place->target->number, place->xy)) ||
           fail(error, ERROR_INPUT, "there is no character \"%s\" to be seen", place->target->name);
}

/// The n-th pin of a rig, in the order of frames.
static const struct pin *pin_named(const struct target_place *place, struct error *error)
{
    const struct document *document = place->editor->core.document;
    const double n = place->target->number[0];
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        if (strcmp(rig_title(rig), place->target->name) == 0 && n >= 0 && n < rig->pin_count)
            return &rig->pins[(int)n];
    }
    fail(error, ERROR_INPUT, "there is no pin %g of \"%s\"", n, place->target->name);
    return NULL;
}

/// The edge of a character's floor: floor(creature).
static bool find_floor(struct target_place *place, struct error *error)
{
    int n;
    const struct editor *editor = place->editor;
    return (rig_named(place, RIG_CHARACTER, &n) && stage_floor_point(editor->stage, &editor->core, n, place->xy)) ||
           fail(error, ERROR_INPUT, "there is no floor of \"%s\" to be seen", place->target->name);
}

/// The marker of a pin on the stage: pin(tail,0).
static bool find_pin(struct target_place *place, struct error *error)
{
    const struct pin *pin = pin_named(place, error);
    if (!pin) return false;
    return stage_pin_point(place->editor->stage, &place->editor->core, pin->id, place->xy) ||
           fail(error, ERROR_INPUT, "that pin of \"%s\" is not in sight", place->target->name);
}

/// Its mark on the ruler: pintime(tail,0).
static bool find_pin_time(struct target_place *place, struct error *error)
{
    const struct editor *editor = place->editor;
    const struct pin *pin = pin_named(place, error);
    if (!pin) return false;
    return curves_pin_point(editor->curves, &editor->core, pin, place->xy) ||
           fail(error, ERROR_INPUT, "that pin of \"%s\" is not on the visible part of the ruler",
                place->target->name);
}

static bool find_divider(struct target_place *place, struct error *error)
{
    const struct layout *l = &place->editor->core.layout;
    bool inspector = strcmp(place->target->name, "inspector") == 0;
    if (!inspector && strcmp(place->target->name, "stage") != 0) {
        return fail(error, ERROR_INPUT, "there is no divider \"%s\": expected stage or inspector",
                    place->target->name);
    }
    place->xy[0] = inspector ? l->inspector.x : l->curves.x + l->curves.w / 2;
    place->xy[1] = inspector ? l->inspector.h / 2 : l->curves.y;
    return true;
}

static bool find_widget(struct target_place *place, struct error *error)
{
    return inspector_target(place->editor->inspector, place->target->name, &place->xy[0], &place->xy[1]) ||
           fail(error, ERROR_INPUT, "the inspector does not show \"%s\"", place->target->name);
}

static const struct target_kind {
    const char *kind;
    bool named;  ///< takes a name
    int numbers; ///< and that many numbers
    find_place *find;
} kinds[] = {
    {.kind = "knot", .named = true, .numbers = 1, .find = find_knot},
    {.kind = "mark", .named = true, .numbers = 1, .find = find_mark},
    {.kind = "handle", .named = true, .numbers = 2, .find = find_handle},
    {.kind = "curve", .named = true, .numbers = 2, .find = find_curve},
    {.kind = "box", .named = false, .numbers = 2, .find = find_box},
    {.kind = "warning", .named = false, .numbers = 1, .find = find_warning},
    {.kind = "ruler", .named = false, .numbers = 1, .find = find_ruler},
    {.kind = "stage", .named = false, .numbers = 2, .find = find_stage},
    {.kind = "pointer", .named = false, .numbers = 2, .find = find_pointer},
    {.kind = "tail", .named = true, .numbers = 1, .find = find_tail},
    {.kind = "chain", .named = true, .numbers = 1, .find = find_chain},
    {.kind = "bone", .named = true, .numbers = 0, .find = find_bone},
    {.kind = "body", .named = true, .numbers = 0, .find = find_body},
    {.kind = "character", .named = true, .numbers = 2, .find = find_character},
    {.kind = "pin", .named = true, .numbers = 1, .find = find_pin},
    {.kind = "pintime", .named = true, .numbers = 1, .find = find_pin_time},
    {.kind = "floor", .named = true, .numbers = 0, .find = find_floor},
    {.kind = "divider", .named = true, .numbers = 0, .find = find_divider},
    {.kind = "slider", .named = true, .numbers = 0, .find = find_widget},
    {.kind = "widget", .named = true, .numbers = 0, .find = find_widget},
};

/// Cuts the last ",number" off `text`; false where there is none.
static bool cut_number(char *text, double *number)
{
    char *comma = strrchr(text, ',');
    char *digits = comma ? comma + 1 : text;
    char *end;
    *number = strtod(digits, &end);
    if (end == digits || *end || !isfinite(*number)) return false;
    *digits = 0;
    if (comma) *comma = 0;
    return true;
}

static const struct target_kind *parse(const char *text, struct target *target)
{
    const char *open = strchr(text, '(');
    size_t length = strlen(text);
    if (!open || text[length - 1] != ')' || length - (size_t)(open - text) > MAX_NAME) return NULL;
    memset(target, 0, sizeof *target);
    memcpy(target->name, open + 1, length - (size_t)(open - text) - 2);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        const struct target_kind *kind = &kinds[i];
        size_t size = strlen(kind->kind);
        if (size != (size_t)(open - text) || strncmp(kind->kind, text, size) != 0) continue;
        for (int n = kind->numbers - 1; n >= 0; n--) {
            if (!cut_number(target->name, &target->number[n])) return NULL;
        }
        return kind->named == (target->name[0] != 0) ? kind : NULL;
    }
    return NULL;
}

bool editor_target(struct editor *editor, const char *target, float *x, float *y, struct error *error)
{
    struct target parts;
    const struct target_kind *kind = parse(target, &parts);
    if (!kind) return fail(error, ERROR_INPUT, "\"%s\" is no target such as knot(sway,2) or stage(0.5,0.5)", target);
    struct target_place place = {.editor = editor, .target = &parts};
    if (!kind->find(&place, error)) return false;
    *x = place.xy[0];
    *y = place.xy[1];
    return true;
}
