/// Dialogs that ask a question: before an edit that touches more than was asked for, and about recovered work.
#include "base/file.h"
#include "editor/core/rigs.h"
#include "editor/core/spline_list.h"
#include "editor/dialogs/state.h"
#include "scene/order.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BUTTON_WIDTH = 104 };

int question_build(struct dialog *dialog)
{
    const struct question *question = &dialog->question;
    struct ui *ui = &dialog->ui;
    ui_label(ui, ui_row(ui, UI_ROW), question->title, theme()->text);
    float top = ui->y;
    bool failed = dialog->error[0] != '\0';
    ui_paragraph(ui, failed ? dialog->error : question->note, failed ? theme()->error : theme()->text_dim);
    ui_space(ui, fmaxf(8, 40 - (ui->y - top)));
    struct rect row = ui_row(ui, 28);
    int pressed = QUESTION_OPEN;
    for (int i = 0; i < question->count; i++) {
        float x = row.x + row.w - (float)(question->count - i) * (BUTTON_WIDTH + UI_GAP) + UI_GAP;
        struct rect r = {x, row.y, BUTTON_WIDTH, row.h};
        const struct answer *answer = &question->answers[i];
        if (ui_button(ui, r, answer->name, answer->label, i == dialog->choice)) pressed = i;
    }
    return pressed;
}

int question_key(struct dialog *dialog, int key)
{
    const struct question *question = &dialog->question;
    int count = question->count;
    switch (key) {
    case KEY_ESCAPE:
        return count - 1;
    case KEY_SPACE:
    case KEY_ENTER:
        return dialog->choice;
    case KEY_LEFT:
    case KEY_UP:
        dialog->choice = (dialog->choice + count - 1) % count;
        return QUESTION_OPEN;
    case KEY_TAB:
    case KEY_RIGHT:
    case KEY_DOWN:
        dialog->choice = (dialog->choice + 1) % count;
        return QUESTION_OPEN;
    default:
        break;
    }
    for (int i = 0; i < count; i++) {
        if (question->answers[i].key == key) return i;
    }
    return QUESTION_UNUSED;
}

static const struct answer fps_answers[] = {
    {"dialog.frames", "Keep frames", 'F'}, {"dialog.seconds", "Keep seconds", 'S'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer range_answers[] = {
    {"dialog.move", "Move", 'M'}, {"dialog.trim", "Trim", 'T'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer remove_answers[] = {{"dialog.delete", "Delete", 'D'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer rig_answers[] = {
    {"dialog.with", "With splines", 'W'}, {"dialog.keep", "Keep splines", 'K'}, {"dialog.cancel", "Cancel", 'C'}};
static const struct answer unsaved_answers[] = {
    [UNSAVED_SAVE] = {"dialog.save", "Save", 'S'},
    [UNSAVED_DISCARD] = {"dialog.discard", "Discard", 'D'},
    [UNSAVED_CANCEL] = {"dialog.cancel", "Cancel", 'C'},
};
enum recover_answer { RECOVER_RECOVER, RECOVER_DISCARD, RECOVER_LATER };
static const struct answer recover_answers[] = {
    [RECOVER_RECOVER] = {"dialog.recover", "Recover", 'R'},
    [RECOVER_DISCARD] = {"dialog.discard", "Discard", 'D'},
    [RECOVER_LATER] = {"dialog.later", "Later", 'L'},
};

enum changed_answer { CHANGED_MINE, CHANGED_THEIRS, CHANGED_SAVE_AS, CHANGED_CANCEL };
static const struct answer changed_answers[] = {
    [CHANGED_MINE] = {"dialog.mine", "Keep mine", 'K'},
    [CHANGED_THEIRS] = {"dialog.theirs", "Take theirs", 'T'},
    [CHANGED_SAVE_AS] = {"dialog.other", "Save as", 'S'},
    [CHANGED_CANCEL] = {"dialog.cancel", "Cancel", 'C'},
};

/// A question with these answers, to be given its words.
#define QUESTION(list) ((struct question){.answers = (list), .count = sizeof(list) / sizeof(list)[0]})

static void ask_fps(struct question *question, const struct document *document, const struct ask *ask)
{
    *question = QUESTION(fps_answers);
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
    int count = spline_list_outside(document, ask->first, ask->last);
    *question = QUESTION(range_answers);
    snprintf(question->title, sizeof question->title, "%d knot%s would fall outside frames %d to %d", count,
             count == 1 ? "" : "s", ask->first, ask->last);
    snprintf(question->note, sizeof question->note,
             "Move shifts them to the nearest free frames inside. Trim deletes them.");
}

static void ask_remove(struct question *question, const struct document *document, int spline)
{
    int count = reference_count(document, spline);
    *question = QUESTION(remove_answers);
    snprintf(question->title, sizeof question->title, "%.200s is used in %d place%s", document->splines[spline]->name,
             count, count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note,
             "Parameters that follow it keep their value at the playhead. Tails and characters on the "
             "stage stop using it.");
}

static void ask_rig(struct question *question, const struct document *document, int rig)
{
    char names[160];
    const int count = rigs_own_splines(document, rig, names, sizeof names);
    *question = QUESTION(rig_answers);
    snprintf(question->title, sizeof question->title, "Remove %.150s, with its spline%s or without?",
             path_name(rig_title(document->rigs[rig])), count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note, "Nothing else moves by %s. Kept, %s for what you add next.",
             names, count == 1 ? "it stays" : "they stay");
}

void dialogs_ask(struct dialogs *dialogs, const struct core *core, const struct ask *ask)
{
    struct question *question = &dialogs->dialog.question;
    if (ask->kind == ASK_ADD) {
        dialog_open(dialogs, DIALOG_ADD);
        return;
    }
    dialogs->dialog.ask = *ask;
    if (ask->kind == ASK_RIG) ask_rig(question, core->document, ask->rig);
    if (ask->kind == ASK_FPS) ask_fps(question, core->document, ask);
    if (ask->kind == ASK_RANGE) ask_range(question, core->document, ask);
    if (ask->kind == ASK_REMOVE) ask_remove(question, core->document, core->active);
    dialog_open(dialogs, DIALOG_ASK);
}

void dialog_ask_answer(struct dialogs *dialogs, struct core *core, int answer)
{
    const struct ask ask = dialogs->dialog.ask;
    bool cancelled = answer == dialogs->dialog.question.count - 1;
    dialog_close(dialogs);
    if (!cancelled) spline_list_answer(core, &ask, answer);
}

void dialog_ask_unsaved(struct dialogs *dialogs, const struct core *core)
{
    struct question *question = &dialogs->dialog.question;
    *question = QUESTION(unsaved_answers);
    snprintf(question->title, sizeof question->title, "%s has unsaved changes", core->title);
    snprintf(question->note, sizeof question->note,
             "Save them, or they will be lost. S saves, D discards, Esc cancels.");
    dialog_open(dialogs, DIALOG_UNSAVED);
}

bool dialogs_ask_changed(struct dialogs *dialogs, const struct core *core, const char *name, bool saving)
{
    struct dialog *dialog = &dialogs->dialog;
    if (!saving && (core->drag.owner || dialogs_cover(dialogs))) return false;
    dialog->question = QUESTION(changed_answers);
    snprintf(dialog->question.title, sizeof dialog->question.title, "%.255s has changed on the disk", name);
    snprintf(dialog->question.note, sizeof dialog->question.note,
             "Keep mine replaces that file %s. Take theirs opens it; undo brings yours back. Save as keeps both.",
             saving ? "now" : "at the next save");
    dialog_open(dialogs, DIALOG_CHANGED);
    dialog->saving = saving;
    dialog->choice = CHANGED_SAVE_AS;
    return true;
}

void dialog_changed_answer(struct dialogs *dialogs, struct core *core, int answer)
{
    switch ((enum changed_answer)answer) {
    case CHANGED_MINE:
        dialog_await(dialogs, core, dialogs->dialog.saving ? REQUEST_OVERWRITE : REQUEST_KEEP_MINE, NULL);
        break;
    case CHANGED_THEIRS:
        dialog_await(dialogs, core, REQUEST_THEIRS, NULL);
        break;
    case CHANGED_SAVE_AS:
        dialogs_save_as(dialogs, core);
        break;
    case CHANGED_CANCEL:
        dialog_close(dialogs);
        break;
    }
}

void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer)
{
    struct question *question = &dialogs->dialog.question;
    char others[64] = "";
    if (offer->others > 0) {
        snprintf(others, sizeof others, "  %d older one%s after this.", offer->others, offer->others > 1 ? "s" : "");
    }
    *question = QUESTION(recover_answers);
    snprintf(question->title, sizeof question->title, "Recover unsaved work on %s?", offer->name);
    snprintf(question->note, sizeof question->note, "Last kept on %s. Later asks again at the next start.%s",
             offer->when, others);
    dialog_open(dialogs, DIALOG_RECOVER);
}

void dialog_recover_answer(struct dialogs *dialogs, struct core *core, int answer)
{
    if (answer == RECOVER_LATER) {
        dialog_close(dialogs);
    } else {
        dialog_await(dialogs, core, answer == RECOVER_RECOVER ? REQUEST_RECOVER : REQUEST_FORGET, NULL);
    }
}
