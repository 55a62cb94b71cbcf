/// Copies, cuts, pastes and duplicates knots.
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "scene/knots.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void say_count(struct core *core, const char *what, int count)
{
    core_message(core, false, "%s %d knot%s.", what, count, count == 1 ? "" : "s");
}

/// Collects the selected knots in core's originals, which no drag is using; returns how many.
static int collect(struct core *core)
{
    core_collect(core, false);
    if (core->originals.count == 0) core_message(core, false, "No knots are selected.");
    return core->originals.count;
}

/// The originals as text. Knots of a single spline leave out its name, so that they can be pasted into any.
static char *print_originals(const struct originals *originals, const struct document *document)
{
    const size_t count = (size_t)originals->count;
    const bool mixed = originals->list[0].spline != originals->list[count - 1].spline;
    struct knot_list list = {need(count, sizeof *list.knots), need(count, sizeof *list.splines), originals->count};
    for (size_t i = 0; i < count; i++) {
        list.knots[i] = originals->list[i].knot;
        list.splines[i] = mixed ? document->splines[originals->list[i].spline]->name : NULL;
    }
    char *text = knots_print(&list);
    free(list.knots);
    free(list.splines); // the document owns the names
    return text;
}

bool core_copy_knots(struct core *core, bool cut)
{
    int count = collect(core);
    if (count == 0) return false;
    char *text = print_originals(&core->originals, core->document);
    free(core->clipboard);
    core->clipboard = text;
    if (cut) core_remove_knots(core, count == 1 ? "Cut knot" : "Cut knots");
    say_count(core, cut ? "Cut" : "Copied", count);
    return true;
}

/// Inserts a shifted copy of a knot in the open step.
static bool insert(struct core *core, int spline, const struct knot *knot, double shift)
{
    struct knot copy = *knot;
    copy.id = 0;
    copy.frame += shift;
    return core_put_knot(core, spline, &copy);
}

/// Selects the knots inserted from `first_id` on.
static void select_from(struct core *core, unsigned first_id)
{
    selection_clear(&core->selection);
    pins_clear(core);
    for (unsigned id = first_id; id < core->document->next_id; id++) selection_set(&core->selection, id, true);
    selected_settle(core);
    core_edited(core, -1);
}

/// The spline a listed knot goes to: the one it names, else the active one.
static int target_of(const struct core *core, const struct knot_list *list, int k)
{
    const char *name = list->splines ? list->splines[k] : NULL;
    const int found = name ? document_find_spline(core->document, name) : -1;
    return found >= 0 ? found : core->active;
}

void core_paste_knots(struct core *core, const char *text)
{
    const struct document *document = core->document;
    struct knot_list list;
    struct error error;
    if (!core_active_spline(core) || history_is_open(core->history)) return; // pasted text may come during a drag
    if (!text || !text[strspn(text, " \t\r\n")]) {
        core_message(core, false, "The clipboard has no text.");
        return;
    }
    if (!knots_parse("clipboard", text, &list, &error)) {
        core_message(core, true, "%s", error.text);
        return;
    }
    const unsigned first_id = document->next_id;
    double first = list.knots[0].frame;
    bool good = true;
    for (int k = 1; k < list.count; k++) first = fmin(first, list.knots[k].frame);
    const double shift = round(core_frame(core)) - first;
    core_step(core, list.count == 1 ? "Paste knot" : "Paste knots", 0);
    for (int k = 0; k < list.count && good; k++)
        good = insert(core, target_of(core, &list, k), &list.knots[k], shift);
    if (good) select_from(core, first_id);
    if (good) say_count(core, "Pasted", list.count);
    knot_list_free(&list);
}

static bool has_room(const struct originals *originals, const struct document *document, double shift)
{
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[i];
        const int sample = document_sample(document, original->knot.frame + shift);
        if (spline_find_knot(document, document->splines[original->spline], sample) >= 0) return false;
    }
    return true;
}

/// Shift of the copies in frames: as far behind the last original as that is behind the one before, or further until all have room.
static double copies_shift(const struct originals *originals, const struct document *document)
{
    double first = INFINITY, last = -INFINITY, before = -INFINITY;
    for (int i = 0; i < originals->count; i++) {
        const double frame = originals->list[i].knot.frame;
        first = fmin(first, frame);
        if (frame > last) before = last;
        if (frame < last) before = fmax(before, frame);
        last = fmax(last, frame);
    }
    const double step = isfinite(before) ? last - before : 1;
    double shift = round(last - first + fmax(step, 1));
    while (!has_room(originals, document, shift)) shift++;
    return shift;
}

/// The last frame the scene needs for the copies. A loop's last sample is its first one.
static int copies_end(const struct originals *originals, const struct document *document, double shift)
{
    double end = document->last_frame;
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[i];
        const bool loops = spline_start(document->splines[original->spline]) == WIGGLY_LOOP;
        end = fmax(end, original->knot.frame + shift + (loops ? 1.0 / document->substeps : 0));
    }
    return (int)fmin(ceil(end), SCENE_MAX_FRAME);
}

void core_duplicate_knots(struct core *core)
{
    struct document *document = core->document;
    const struct originals *originals = &core->originals;
    const int count = collect(core);
    if (count == 0) return;
    const double shift = copies_shift(originals, document);
    const unsigned first_id = document->next_id;
    const int end = copies_end(originals, document, shift);
    const bool longer = end > document->last_frame;
    if (!core_step(core, count == 1 ? "Duplicate knot" : "Duplicate knots", 0)) return;
    bool good = !longer || edit_range(document, document->first_frame, end, RANGE_REFUSE, &core->error);
    for (int i = 0; i < count && good; i++)
        good = insert(core, originals->list[i].spline, &originals->list[i].knot, shift);
    if (!good) return;
    select_from(core, first_id);
    say_count(core, "Duplicated", count);
    if (!longer) return;
    core_message(core, false, "Duplicated %d knot%s; the scene now ends on frame %d.", count, count == 1 ? "" : "s",
                 end);
}
