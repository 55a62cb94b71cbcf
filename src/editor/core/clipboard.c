/// Knots on the clipboard and twice: copy, cut, paste at the playhead, duplicate.
#include "editor/core/actions.h"
#include "scene/knots.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *editor_clipboard(const struct editor *editor) { return editor->clipboard ? editor->clipboard : ""; }

static void say_count(struct editor *editor, const char *what, int count)
{
    char text[64];
    snprintf(text, sizeof text, "%s %d knot%s.", what, count, count == 1 ? "" : "s");
    editor_message(editor, false, text);
}

/// The selected knots in drag.originals, which no drag needs now; how many there are.
static int collect(struct editor *editor, const struct editor_world *world)
{
    const struct spline *spline = editor_active_spline(editor, world);
    if (!spline || history_is_open(world->history)) return 0;
    editor->drag.ripple = false;
    drag_collect(editor, spline);
    if (editor->drag.count == 0) editor_message(editor, false, "No knots are selected.");
    return editor->drag.count;
}

bool copy_knots(struct editor *editor, const struct editor_world *world, bool cut)
{
    int count = collect(editor, world);
    if (count == 0) return false;
    char *text = knots_print(editor->drag.originals, count);
    if (!text) {
        editor_message(editor, true, "Not enough memory to copy these knots.");
        return false;
    }
    free(editor->clipboard);
    editor->clipboard = text;
    if (cut) remove_knots(editor, world, count == 1 ? "Cut knot" : "Cut knots");
    say_count(editor, cut ? "Cut" : "Copied", count);
    return true;
}

/// Inserts copies of knots, `shift` frames later, as one step, and selects them; nothing where one cannot be inserted.
static bool insert_all(struct editor *editor, const struct editor_world *world, const char *label,
                       const struct knot *knots, int count, double shift)
{
    struct document *document = world->document;
    unsigned first_id = document->next_id;
    bool good = true;
    history_begin(world->history, label, 0);
    for (int k = 0; k < count && good; k++) {
        struct edit edit = editor_edit_of(EDIT_KNOT_INSERT, editor->active);
        edit.knot = knots[k];
        edit.knot.id = 0;
        edit.knot.frame += shift;
        good = editor_edit(editor, world, &edit);
    }
    if (!good) history_restart(world->history, document);
    history_end(world->history);
    if (!good) return false;
    editor_reserve(editor, document);
    selection_clear(&editor->selection);
    for (unsigned id = first_id; id < document->next_id; id++) selection_set(&editor->selection, id, true);
    return true;
}

void paste_knots(struct editor *editor, const struct editor_world *world, const char *text)
{
    struct knot_list list;
    struct error error;
    if (!editor_active_spline(editor, world) || history_is_open(world->history)) return;
    if (!text || !text[strspn(text, " \t\r\n")]) {
        editor_message(editor, false, "The clipboard has no text.");
        return;
    }
    if (!knots_parse("clipboard", text, &list, &error)) {
        editor_message(editor, true, error.text);
        return;
    }
    double first = list.knots[0].frame;
    for (int k = 1; k < list.count; k++) first = fmin(first, list.knots[k].frame);
    double shift = round(editor_frame(editor, world->document)) - first;
    if (insert_all(editor, world, list.count == 1 ? "Paste knot" : "Paste knots", list.knots, list.count, shift)) {
        say_count(editor, "Pasted", list.count);
    }
    knot_list_free(&list);
}

/// Whether copies of the collected knots would find free samples, `shift` frames later.
static bool has_room(const struct editor *editor, const struct document *document, const struct spline *spline,
                     double shift)
{
    for (int k = 0; k < editor->drag.count; k++) {
        int sample = document_sample(document, editor->drag.originals[k].frame + shift);
        if (spline_find_knot(document, spline, sample) >= 0) return false;
    }
    return true;
}

void duplicate_knots(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct spline *spline = editor_active_spline(editor, world);
    const struct drag *drag = &editor->drag;
    int count = collect(editor, world);
    if (count == 0) return;
    const struct knot *last = &drag->originals[count - 1];
    double end = document_frame(document, document_last_knot_sample(document, spline));
    double step = count > 1 ? last->frame - drag->originals[count - 2].frame : 1;
    double shift = round(last->frame - drag->originals[0].frame + fmax(step, 1));
    while (last->frame + shift <= end && !has_room(editor, document, spline, shift)) shift++;
    if (last->frame + shift > end) {
        editor_message(editor, false, "No room for copies before the end of the range.");
    } else if (insert_all(editor, world, count == 1 ? "Duplicate knot" : "Duplicate knots", drag->originals, count,
                          shift)) {
        say_count(editor, "Duplicated", count);
    }
}
