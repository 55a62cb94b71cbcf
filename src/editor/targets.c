/// Names for places on the screen, as replays use them: "knot(sway,2)", "tail(tail,0.9)". They survive layout changes.
#include "editor/core/bones.h"
#include "editor/curves/curves.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "editor/transport/transport.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NUMBERS = 2, MAX_NAME = 256 };

/// A parsed target, kind(name,number,…), and the part of the document it names. The name may hold anything; the numbers follow the last
/// commas.
struct target {
    char name[MAX_NAME];
    double number[MAX_NUMBERS];
    int spline;
    const struct knot *knot;
    int rig, nth; ///< index among all rigs; among its kind
    const struct pin *pin;
};

/// Not const because inspector_target() lays out its widgets; the editor ends up unchanged.
typedef bool find_place(struct editor *editor, const struct target *target, float xy[2]);

static bool in_plot(const struct editor *editor, double frame, double value, float xy[2])
{
    const struct rect *plot = &editor->core.layout.plot;
    xy[0] = curves_x(editor->curves, &editor->core, frame);
    xy[1] = curves_y(editor->curves, &editor->core, value);
    return xy[0] >= plot->x && xy[1] >= plot->y && xy[0] <= plot->x + plot->w && xy[1] <= plot->y + plot->h;
}

static bool find_knot(struct editor *editor, const struct target *target, float xy[2])
{
    const struct document *document = editor->core.document;
    return in_plot(editor, document_frame(document, document_sample(document, target->knot->frame)),
                   core_knot_value(&editor->core, target->spline, target->knot), xy);
}

/// mark(sway,2): a knot on the dope sheet.
static bool find_mark(struct editor *editor, const struct target *target, float xy[2])
{
    return curves_mark_point(editor->curves, &editor->core, target->spline, (int)target->number[0], xy);
}

/// handle(sway,2,1): a slope handle's end, 0 before and 1 after the knot.
static bool find_handle(struct editor *editor, const struct target *target, float xy[2])
{
    curves_handle(editor->curves, &editor->core, target->knot, target->number[1] > 0, xy);
    return target->knot->has_slope;
}

static bool find_curve(struct editor *editor, const struct target *target, float xy[2])
{
    return in_plot(editor, target->number[0], target->number[1], xy);
}

/// box(1,0): a handle of the selection box, here the middle of its right edge; box(-1,-1) is the upper left corner.
static bool find_box(struct editor *editor, const struct target *target, float xy[2])
{
    return curves_box_point(editor->curves, &editor->core, (int)target->number[0], (int)target->number[1], xy);
}

static bool find_warning(struct editor *editor, const struct target *target, float xy[2])
{
    return curves_warning(editor->curves, &editor->core, target->number[0], xy);
}

static bool find_ruler(struct editor *editor, const struct target *target, float xy[2])
{
    const struct rect *ruler = &editor->core.layout.ruler;
    xy[0] = curves_x(editor->curves, &editor->core, target->number[0]);
    xy[1] = ruler->y + ruler->h / 2;
    return rect_contains(*ruler, xy[0], xy[1]);
}

static bool find_stage(struct editor *editor, const struct target *target, float xy[2])
{
    const struct rect *stage = &editor->core.layout.stage;
    xy[0] = stage->x + stage->w * (float)target->number[0];
    xy[1] = stage->y + stage->h * (float)target->number[1];
    return true;
}

/// pointer(0.1,0): relative to the pointer, in heights of the stage.
static bool find_pointer(struct editor *editor, const struct target *target, float xy[2])
{
    const struct core *core = &editor->core;
    xy[0] = core->pointer_x + core->layout.stage.h * (float)target->number[0];
    xy[1] = core->pointer_y + core->layout.stage.h * (float)target->number[1];
    return true;
}

/// A place along a tail or chain: 0 is the first joint, 1 the tip.
static bool find_along(struct editor *editor, const struct target *target, float xy[2])
{
    const int joints = bones_joints(&editor->core, target->rig);
    const double along = fmin(fmax(target->number[0], 0), 1) * joints;
    const int joint = (int)fmin(floor(along), joints - 1);
    return stage_project(editor->stage, &editor->core, target->rig, joint, along - joint, xy);
}

/// The text after the character's name and a slash, or the whole text.
static const char *bone_name(const struct rig *character, const char *text)
{
    const char *title = rig_title(character);
    const size_t length = strlen(title);
    return strncmp(text, title, length) == 0 && text[length] == '/' ? text + length + 1 : text;
}

/// bone(tail_1): the first such bone of all characters; bone(dog 2/tail_1): that character's.
static bool find_bone(struct editor *editor, const struct target *target, float xy[2])
{
    const struct document *document = editor->core.document;
    for (int r = -1; (r = document_next_rig(document, RIG_MODEL, r)) >= 0;) {
        const struct imported *shown = bones_character(&editor->core, r);
        const int node = shown ? gltf_find_node(&shown->gltf, bone_name(document->rigs[r], target->name)) : -1;
        if (node >= 0 && stage_bone_point(editor->stage, &editor->core, r, node, xy)) return true;
    }
    return false;
}

static bool find_body(struct editor *editor, const struct target *target, float xy[2])
{
    return stage_body_point(editor->stage, &editor->core, target->nth, xy);
}

/// character(up,0.5,0.8): a surface point where it is now. u runs across and v up the rest pose's box, seen from the front.
static bool find_character(struct editor *editor, const struct target *target, float xy[2])
{
    return stage_character_point(editor->stage, target->nth, target->number, xy);
}

/// floor(creature): the edge of a character's floor.
static bool find_floor(struct editor *editor, const struct target *target, float xy[2])
{
    return stage_floor_point(editor->stage, &editor->core, target->nth, xy);
}

/// pin(tail,0): a pin's marker on the stage, counted by frame.
static bool find_pin(struct editor *editor, const struct target *target, float xy[2])
{
    return stage_pin_point(editor->stage, &editor->core, target->pin, xy);
}

/// pintime(tail,0): its mark on the ruler.
static bool find_pin_time(struct editor *editor, const struct target *target, float xy[2])
{
    return curves_pin_point(editor->curves, &editor->core, target->pin, xy);
}

static bool find_divider(struct editor *editor, const struct target *target, float xy[2])
{
    const struct layout *l = &editor->core.layout;
    const bool inspector = strcmp(target->name, "inspector") == 0;
    xy[0] = inspector ? l->inspector.x : l->curves.x + l->curves.w / 2;
    xy[1] = inspector ? l->inspector.h / 2 : l->curves.y;
    return inspector || strcmp(target->name, "stage") == 0;
}

static bool find_widget(struct editor *editor, const struct target *target, float xy[2])
{
    return inspector_target(editor->inspector, target->name, &xy[0], &xy[1]) ||
           transport_target(&editor->status, &editor->core, target->name, &xy[0], &xy[1]);
}

/// What a target's name belongs to.
enum target_of { OF_NOBODY, OF_ITSELF, OF_SPLINE, OF_KNOT, OF_RIG, OF_PIN };

static const struct target_kind {
    const char *kind;
    enum target_of of;
    enum rig_kind rig; ///< OF_RIG
    int numbers;       ///< how many follow the name
    find_place *find;
    const char *missing; ///< why the subject has no such place
} kinds[] = {
    {"knot", OF_KNOT, 0, 1, find_knot, "that knot is not in the visible part of the curves"},
    {"mark", OF_KNOT, 0, 1, find_mark, "the dope sheet does not show that knot"},
    {"handle", OF_KNOT, 0, 2, find_handle, "that knot has no slope"},
    {"curve", OF_SPLINE, 0, 2, find_curve, "that is not in the visible part of the curves"},
    {"box", OF_NOBODY, 0, 2, find_box, "the selected knots have no such handle"},
    {"warning", OF_NOBODY, 0, 1, find_warning, "that warning is not to be seen"},
    {"ruler", OF_NOBODY, 0, 1, find_ruler, "that frame is not on the visible part of the ruler"},
    {"stage", OF_NOBODY, 0, 2, find_stage, ""},
    {"pointer", OF_NOBODY, 0, 2, find_pointer, ""},
    {"tail", OF_RIG, RIG_TAIL, 1, find_along, "that tail is not to be seen"},
    {"chain", OF_RIG, RIG_CHAIN, 1, find_along, "that chain is not to be seen"},
    {"bone", OF_ITSELF, 0, 0, find_bone, "there is no such bone to be seen"},
    {"body", OF_RIG, RIG_TAIL, 0, find_body, "no body of that tail is to be seen"},
    {"character", OF_RIG, RIG_CHARACTER, 2, find_character, "that character is not to be seen"},
    {"pin", OF_PIN, 0, 1, find_pin, "that pin is not in sight"},
    {"pintime", OF_PIN, 0, 1, find_pin_time, "that pin is not on the visible part of the ruler"},
    {"floor", OF_RIG, RIG_CHARACTER, 0, find_floor, "no floor of that character is to be seen"},
    {"divider", OF_ITSELF, 0, 0, find_divider, "there is no such divider: expected stage or inspector"},
    {"slider", OF_ITSELF, 0, 0, find_widget, "neither inspector nor status line shows it"},
    {"widget", OF_ITSELF, 0, 0, find_widget, "neither inspector nor status line shows it"},
};

/// Finds the spline of the name, and its knot if the kind needs one.
static bool find_spline(const struct document *document, const struct target_kind *kind, struct target *target,
                        struct error *error)
{
    const double k = target->number[0];
    target->spline = document_find_spline(document, target->name);
    if (target->spline < 0) return fail(error, ERROR_INPUT, "there is no spline \"%s\"", target->name);
    const struct spline *spline = document->splines[target->spline];
    if (kind->of == OF_SPLINE) return true;
    if (!(k >= 0 && k < spline->knot_count))
        return fail(error, ERROR_INPUT, "the spline \"%s\" has %d knots, no knot %g", spline->name,
                    spline->knot_count, k);
    target->knot = &spline->knots[(int)k];
    return true;
}

/// Finds the rig of the kind and name, or one with such a pin. An unnamed character goes by its model.
static bool find_rig(const struct document *document, const struct target_kind *kind, struct target *target,
                     struct error *error)
{
    const double n = target->number[0];
    for (target->rig = target->nth = 0; target->rig < document->rig_count; target->rig++) {
        const struct rig *rig = document->rigs[target->rig];
        const bool is_named = strcmp(rig_title(rig), target->name) == 0;
        if (kind->of == OF_RIG && rig->kind == kind->rig && is_named) return true;
        if (kind->of == OF_PIN && is_named && n >= 0 && n < rig->pin_count) target->pin = &rig->pins[(int)n];
        if (target->pin) return true;
        target->nth += rig->kind == kind->rig;
    }
    if (kind->of == OF_PIN) return fail(error, ERROR_INPUT, "there is no pin %g of \"%s\"", n, target->name);
    return fail(error, ERROR_INPUT, "there is no %s \"%s\"", rig_word(kind->rig), target->name);
}

/// Cuts the last ",number" off `text`; false if there is none.
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
        return (kind->of != OF_NOBODY) == (target->name[0] != 0) ? kind : NULL;
    }
    return NULL;
}

bool editor_target(struct editor *editor, const char *text, float *x, float *y, struct error *error)
{
    const struct document *document = editor->core.document;
    struct target target;
    float xy[2];
    const struct target_kind *kind = parse(text, &target);
    if (!kind) return fail(error, ERROR_INPUT, "\"%s\" is no target such as knot(sway,2) or stage(0.5,0.5)", text);
    if ((kind->of == OF_SPLINE || kind->of == OF_KNOT) && !find_spline(document, kind, &target, error)) return false;
    if ((kind->of == OF_RIG || kind->of == OF_PIN) && !find_rig(document, kind, &target, error)) return false;
    if (!kind->find(editor, &target, xy)) return fail(error, ERROR_INPUT, "%s", kind->missing);
    *x = xy[0];
    *y = xy[1];
    return true;
}
