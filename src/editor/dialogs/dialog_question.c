/// Question dialogs: core's own, and those about unsaved, changed and recovered work.
#include "editor/dialogs/state.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

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
    const float width = fminf(BUTTON_WIDTH, floorf((row.w + UI_GAP) / (float)question->count) - UI_GAP);
    int pressed = QUESTION_OPEN;
    for (int i = 0; i < question->count; i++) {
        float x = row.x + row.w - (float)(question->count - i) * (width + UI_GAP) + UI_GAP;
        struct rect r = {x, row.y, width, row.h};
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

bool dialogs_ask(struct dialogs *dialogs, struct core *core)
{
    const bool adds = core->request.kind == REQUEST_ADD && !core->request.path[0];
    if (adds) {
        core->request.kind = REQUEST_NONE;
        dialog_open(dialogs, DIALOG_ADD, "");
    } else if (core->question.count > 0) {
        dialogs->dialog.question = core->question;
        core->question.count = 0;
        dialog_open(dialogs, DIALOG_ASK, "");
        return true;
    }
    return adds;
}

/// A question with these answers and still without a text.
#define QUESTION(list, what)                                                                                         \
    ((struct question){.answers = (list), .count = sizeof(list) / sizeof(list)[0], .answered = (what)})

enum unsaved_answer { UNSAVED_SAVE, UNSAVED_DISCARD, UNSAVED_CANCEL };
static const struct answer unsaved_answers[] = {
    [UNSAVED_SAVE] = {"dialog.save", "Save", 'S'},
    [UNSAVED_DISCARD] = {"dialog.discard", "Discard", 'D'},
    [UNSAVED_CANCEL] = {"dialog.cancel", "Cancel", 'C'},
};

static void answer_unsaved(void *of, struct core *core, int answer)
{
    struct dialogs *dialogs = of;
    const struct request after = dialogs->dialog.after;
    if (answer == UNSAVED_DISCARD) {
        dialog_close(dialogs);
        dialog_go_on(dialogs, core, &after);
    } else if (core->path[0]) {
        dialog_await(dialogs, core, REQUEST_SAVE, NULL);
    } else {
        dialogs_save_as(dialogs, core);
    }
}

void dialogs_leave(struct dialogs *dialogs, struct core *core, const struct request *after)
{
    struct question *question = &dialogs->dialog.question;
    if (history_is_saved(core->history)) {
        dialog_go_on(dialogs, core, after);
        return;
    }
    *question = QUESTION(unsaved_answers, answer_unsaved);
    snprintf(question->title, sizeof question->title, "%s has unsaved changes", core->title);
    snprintf(question->note, sizeof question->note,
             "Save them, or they will be lost. S saves, D discards, Esc cancels.");
    dialog_open(dialogs, DIALOG_UNSAVED, "");
    dialogs->dialog.after = *after;
}

enum changed_answer { CHANGED_MINE, CHANGED_THEIRS, CHANGED_SAVE_AS, CHANGED_CANCEL };
static const struct answer changed_answers[] = {
    [CHANGED_MINE] = {"dialog.mine", "Keep mine", 'K'},
    [CHANGED_THEIRS] = {"dialog.theirs", "Take theirs", 'T'},
    [CHANGED_SAVE_AS] = {"dialog.other", "Save as", 'S'},
    [CHANGED_CANCEL] = {"dialog.cancel", "Cancel", 'C'},
};

static void answer_changed(void *of, struct core *core, int answer)
{
    struct dialogs *dialogs = of;
    if (answer == CHANGED_SAVE_AS) {
        dialogs_save_as(dialogs, core);
    } else {
        const enum request_kind mine = dialogs->dialog.saving ? REQUEST_OVERWRITE : REQUEST_KEEP_MINE;
        dialog_await(dialogs, core, answer == CHANGED_MINE ? mine : REQUEST_THEIRS, NULL);
    }
}

bool dialogs_ask_changed(struct dialogs *dialogs, const struct core *core, const char *name, bool saving)
{
    struct dialog *dialog = &dialogs->dialog;
    struct question *question = &dialog->question;
    if (!saving && (core->drag.owner || dialogs_cover(dialogs))) return false;
    *question = QUESTION(changed_answers, answer_changed);
    snprintf(question->title, sizeof question->title, "%.255s has changed on the disk", name);
    snprintf(question->note, sizeof question->note,
             "Keep mine replaces that file %s. Take theirs opens it; undo brings yours back. Save as keeps both.",
             saving ? "now" : "at the next save");
    dialog_open(dialogs, DIALOG_CHANGED, "");
    dialog->saving = saving;
    dialog->choice = CHANGED_SAVE_AS;
    return true;
}

enum recover_answer { RECOVER_RECOVER, RECOVER_DISCARD, RECOVER_LATER };
static const struct answer recover_answers[] = {
    [RECOVER_RECOVER] = {"dialog.recover", "Recover", 'R'},
    [RECOVER_DISCARD] = {"dialog.discard", "Discard", 'D'},
    [RECOVER_LATER] = {"dialog.later", "Later", 'L'},
};

static void answer_recovery(void *of, struct core *core, int answer)
{
    dialog_await(of, core, answer == RECOVER_RECOVER ? REQUEST_RECOVER : REQUEST_FORGET, NULL);
}

void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer)
{
    struct question *question = &dialogs->dialog.question;
    char others[64] = "";
    if (offer->others > 0) {
        snprintf(others, sizeof others, "  %d older one%s after this.", offer->others, offer->others > 1 ? "s" : "");
    }
    *question = QUESTION(recover_answers, answer_recovery);
    snprintf(question->title, sizeof question->title, "Recover unsaved work on %s?", offer->name);
    snprintf(question->note, sizeof question->note, "Last kept on %s. Later asks again at the next start.%s",
             offer->when, others);
    dialog_open(dialogs, DIALOG_RECOVER, "");
}
