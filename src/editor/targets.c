/// Names for places on the screen, as replays use them: "knot(sway,2)", "tail(tail,0.9)". They survive layout changes.
#include "editor/curves/curves.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "editor/transport/transport.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool find_divider(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct layout *l = &core->layout;
    const bool inspector = strcmp(target->name, "inspector") == 0;
    (void)room;
    xy[0] = inspector ? l->inspector.x : l->curves.x + l->curves.w / 2;
    xy[1] = inspector ? l->inspector.h / 2 : l->curves.y;
    return inspector || strcmp(target->name, "stage") == 0;
}

/// Lays out the widgets; the editor ends up unchanged.
static bool find_widget(void *room, const struct core *core, const struct target *target, float xy[2])
{
    struct editor *editor = room;
    (void)core;
    return inspector_target(editor->inspector, target->name, &xy[0], &xy[1]) ||
           transport_target(&editor->status, &editor->core, target->name, &xy[0], &xy[1]);
}

static const char hidden[] = "neither inspector nor status line shows it";

static const struct thing divider = {.name = "divider",
                                     .of = OF_ITSELF,
                                     .find = find_divider,
                                     .missing = "there is no such divider: expected stage or inspector"},
                          slider = {.name = "slider", .of = OF_ITSELF, .find = find_widget, .missing = hidden},
                          widget = {.name = "widget", .of = OF_ITSELF, .find = find_widget, .missing = hidden};

static const struct thing *const editor_things[] = {&divider, &slider, &widget, NULL};

/// Parses kind(name,number,…). Returns the kind's thing in a list, or NULL.
static const struct thing *parse(const struct thing *const *things, const char *text, struct target *target)
{
    const size_t kind = strcspn(text, "("), length = strlen(text);
    while (*things && (strlen((*things)->name) != kind || strncmp((*things)->name, text, kind) != 0)) things++;
    if (!*things || kind == length || text[length - 1] != ')' || length - kind > sizeof target->name) return NULL;
    *target = (struct target){.name = ""};
    memcpy(target->name, text + kind + 1, length - kind - 2);
    for (int n = (*things)->numbers - 1; n >= 0; n--) {
        char *comma = strrchr(target->name, ','), *digits = comma ? comma + 1 : target->name, *end;
        target->number[n] = strtod(digits, &end);
        if (end == digits || *end || !isfinite(target->number[n])) return NULL;
        *(comma ? comma : digits) = 0;
    }
    return ((*things)->of != OF_NOBODY) == (target->name[0] != 0) ? *things : NULL;
}

bool editor_target(struct editor *editor, const char *text, float *x, float *y, struct error *error)
{
    const struct thing *const *const lists[] = {curves_things, stage_things, editor_things};
    void *const rooms[] = {editor->curves, editor->stage, editor};
    const struct document *document = editor->core.document;
    const struct thing *thing = NULL;
    struct target target;
    float xy[2];
    int list = -1;
    while (!thing && ++list < 3) thing = parse(lists[list], text, &target);
    if (!thing) return fail(error, ERROR_INPUT, "\"%s\" is no target such as knot(sway,2) or stage(0.5,0.5)", text);
    const double k = target.number[0];
    if (thing->of == OF_SPLINE || thing->of == OF_KNOT) {
        target.spline = document_find_spline(document, target.name);
        if (target.spline < 0) return fail(error, ERROR_INPUT, "there is no spline \"%s\"", target.name);
        const struct spline *spline = document->splines[target.spline];
        if (thing->of == OF_KNOT && !(k >= 0 && k < spline->knot_count))
            return fail(error, ERROR_INPUT, "the spline \"%s\" has %d knots, no knot %g", spline->name,
                        spline->knot_count, k);
        if (thing->of == OF_KNOT) target.knot = &spline->knots[(int)k];
    }
    bool found = thing->of != OF_RIG && thing->of != OF_PIN;
    while (!found && target.rig < document->rig_count) {
        const struct rig *rig = document->rigs[target.rig];
        found = strcmp(rig_title(rig), target.name) == 0; // an unnamed character goes by its model
        if (thing->of == OF_PIN) {
            found &= k >= 0 && k < rig->pin_count;
            if (found) target.pin = &rig->pins[(int)k];
        } else {
            found &= rig->kind == thing->rig;
            target.nth += !found && rig->kind == thing->rig;
        }
        target.rig += !found;
    }
    if (!found && thing->of == OF_PIN)
        return fail(error, ERROR_INPUT, "there is no pin %g of \"%s\"", k, target.name);
    if (!found) return fail(error, ERROR_INPUT, "there is no %s \"%s\"", rig_word(thing->rig), target.name);
    if (!thing->find(rooms[list], &editor->core, &target, xy)) return fail(error, ERROR_INPUT, "%s", thing->missing);
    *x = xy[0];
    *y = xy[1];
    return true;
}
