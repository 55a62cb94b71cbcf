/// Knots on the clipboard, and duplicates: copy, cut, paste at the playhead, duplicate.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "scene/knots.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void say_count(struct core *core, const char *what, int count)
{
    char text[64];
    snprintf(text, sizeof text, "%s %d knot%s.", what, count, count == 1 ? "" : "s");
    core_message(core, false, text);
}

/// The selected knots in drag.originals, which no drag needs now; how many there are.
static int collect(struct core *core, const struct editor_world *world)
{
    const struct spline *spline = core_active_spline(core, world);
    if (!spline || history_is_open(world->history)) return 0;
    core_collect(core, spline);
    if (core->originals.count == 0) core_message(core, false, "No knots are selected.");
    return core->originals.count;
}

bool core_copy_knots(struct core *core, const struct editor_world *world, bool cut)
{
    int count = collect(core, world);
    if (count == 0) return false;
    char *text = knots_print(core->originals.knot, count);
    if (!text) {
        core_message(core, true, "Not enough memory to copy these knots.");
        return false;
    }
    free(core->clipboard);
    core->clipboard = text;
    if (cut) core_remove_knots(core, world, count == 1 ? "Cut knot" : "Cut knots");
    say_count(core, cut ? "Cut" : "Copied", count);
    return true;
}

/// Inserts copies of knots, `shift` frames later, as one step, and selects them; nothing where one cannot be inserted.
static bool insert_all(struct core *core, const struct editor_world *world, const char *label,
                       const struct knot *knots, int count, double shift)
{
    struct document *document = world->document;
    unsigned first_id = document->next_id;
    bool good = true;
    history_begin(world->history, label, 0);
    for (int k = 0; k < count && good; k++) {
        struct edit edit = core_edit_of(EDIT_KNOT_INSERT, core->active);
        edit.knot = knots[k];
        edit.knot.id = 0;
        edit.knot.frame += shift;
        good = core_edit(core, world, &edit);
    }
    if (!good) history_restart(world->history, document);
    history_end(world->history);
    if (!good) return false;
    core_reserve(core, document);
    selection_clear(&core->selection);
    pins_clear(core);
    for (unsigned id = first_id; id < document->next_id; id++) selection_set(&core->selection, id, true);
    return true;
}

void core_paste_knots(struct core *core, const struct editor_world *world, const char *text)
{
    struct knot_list list;
    struct error error;
    if (!core_active_spline(core, world) || history_is_open(world->history)) return;
    if (!text || !text[strspn(text, " \t\r\n")]) {
        core_message(core, false, "The clipboard has no text.");
        return;
    }
    if (!knots_parse("clipboard", text, &list, &error)) {
        core_message(core, true, error.text);
        return;
    }
    double first = list.knots[0].frame;
    for (int k = 1; k < list.count; k++) first = fmin(first, list.knots[k].frame);
    double shift = round(core_frame(core, world->document)) - first;
    if (insert_all(core, world, list.count == 1 ? "Paste knot" : "Paste knots", list.knots, list.count, shift)) {
        say_count(core, "Pasted", list.count);
    }
    knot_list_free(&list);
}

/// Whether copies of the collected knots would find free samples, `shift` frames later.
static bool has_room(const struct core *core, const struct document *document, const struct spline *spline,
                     double shift)
{
    for (int k = 0; k < core->originals.count; k++) {
        int sample = document_sample(document, core->originals.knot[k].frame + shift);
        if (spline_find_knot(document, spline, sample) >= 0) return false;
    }
    return true;
}

void core_duplicate_knots(struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct spline *spline = core_active_spline(core, world);
    const struct originals *originals = &core->originals;
    int count = collect(core, world);
    if (count == 0) return;
    const struct knot *last = &originals->knot[count - 1];
    double end = document_frame(document, document_last_knot_sample(document, spline));
    double step = count > 1 ? last->frame - originals->knot[count - 2].frame : 1;
    double shift = round(last->frame - originals->knot[0].frame + fmax(step, 1));
    while (last->frame + shift <= end && !has_room(core, document, spline, shift)) shift++;
    if (last->frame + shift > end) {
        core_message(core, false, "No room for copies before the end of the range.");
    } else if (insert_all(core, world, count == 1 ? "Duplicate knot" : "Duplicate knots", originals->knot, count,
                          shift)) {
        say_count(core, "Duplicated", count);
    }
}
