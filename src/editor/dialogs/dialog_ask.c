/// Questions before an edit that touches more than what was asked for: frames per second, a smaller range, deleting a
/// spline that others follow.
#include "editor/core/arrange.h"
#include "editor/dialogs/dialog.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/dialog_ask.h"
#include "editor/dialogs/state.h"
#include "scene/reference.h"
#include <stdio.h>

static const struct answer fps_answers[] = {
    {"dialog.frames", "Keep frames", 'F'}, {"dialog.seconds", "Keep seconds", 'S'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer range_answers[] = {
    {"dialog.move", "Move", 'M'}, {"dialog.trim", "Trim", 'T'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer remove_answers[] = {{"dialog.delete", "Delete", 'D'}, {"dialog.cancel", "Cancel", 'C'}};

static void ask_fps(struct question *question, const struct document *document, const struct ask *ask)
{
    question->answers = fps_answers;
    question->count = sizeof fps_answers / sizeof fps_answers[0];
    snprintf(question->title, sizeof question->title, "%g frames per second instead of %g", ask->number,
             document->fps);
    snprintf(
        question->note, sizeof question->note,
        "Keep frames: knots stay on their frames, and everything goes %s. Keep seconds: knots and range move to new "
        "frames and the timing stays.",
        ask->number > document->fps ? "faster" : "slower");
}

static void ask_range(struct question *question, const struct document *document, const struct ask *ask)
{
    int count = arrange_outside(document, ask->first, ask->last);
    question->answers = range_answers;
    question->count = sizeof range_answers / sizeof range_answers[0];
    snprintf(question->title, sizeof question->title, "%d knot%s would fall outside frames %d to %d", count,
             count == 1 ? "" : "s", ask->first, ask->last);
    snprintf(question->note, sizeof question->note,
             "Move shifts them to the nearest free frames inside. Trim deletes them.");
}

static void ask_remove(struct question *question, const struct document *document, int spline)
{
    int count = reference_count(document, spline);
    question->answers = remove_answers;
    question->count = sizeof remove_answers / sizeof remove_answers[0];
    snprintf(question->title, sizeof question->title, "%.200s is used in %d place%s", document->splines[spline].name,
             count, count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note,
             "Parameters that follow it keep their value at the playhead. Tails and characters on the "
             "stage stop using it.");
}

void dialogs_ask(struct dialogs *dialogs, const struct core *core, const struct editor_world *world,
                 const struct ask *ask)
{
    struct question *question = &dialogs->dialog.question;
    *question = (struct question){0};
    dialogs->dialog.ask = *ask;
    if (ask->kind == ASK_FPS) ask_fps(question, world->document, ask);
    if (ask->kind == ASK_RANGE) ask_range(question, world->document, ask);
    if (ask->kind == ASK_REMOVE) ask_remove(question, world->document, core->active);
    dialog_open(dialogs, DIALOG_ASK);
}

void dialog_ask_answer(struct dialogs *dialogs, struct core *core, const struct editor_world *world, int answer)
{
    const struct ask ask = dialogs->dialog.ask;
    bool cancelled = answer == dialogs->dialog.question.count - 1;
    dialog_close(dialogs);
    if (!cancelled) arrange_answer(core, world, &ask, answer);
}
