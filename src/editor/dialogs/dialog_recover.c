/// What to do with unsaved work that an earlier run left behind: recover it, discard it, or decide later.
#include "editor/dialogs/dialog_recover.h"
#include "editor/dialogs/dialog.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/state.h"
#include <stdio.h>

static const struct answer answers[] = {
    [RECOVER_RECOVER] = {"dialog.recover", "Recover", 'R'},
    [RECOVER_DISCARD] = {"dialog.discard", "Discard", 'D'},
    [RECOVER_LATER] = {"dialog.later", "Later", 'L'},
};

void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer)
{
    dialogs->dialog.offer = *offer;
    dialog_open(dialogs, DIALOG_RECOVER);
}

void dialog_recover_question(const struct dialogs *dialogs, struct question *question)
{
    const struct recovery_offer *offer = &dialogs->dialog.offer;
    char others[64] = "";
    if (offer->others > 0) {
        snprintf(others, sizeof others, "  %d older one%s after this.", offer->others, offer->others > 1 ? "s" : "");
    }
    question->answers = answers;
    question->count = sizeof answers / sizeof answers[0];
    snprintf(question->title, sizeof question->title, "Recover unsaved work on %s?", offer->name);
    snprintf(question->note, sizeof question->note, "Last kept on %s. Later asks again at the next start.%s",
             offer->when, others);
}

void dialog_recover_answer(struct dialogs *dialogs, struct core *core, int answer)
{
    if (answer == RECOVER_LATER) {
        dialog_close(dialogs);
    } else {
        dialog_await(dialogs, core, answer == RECOVER_RECOVER ? REQUEST_RECOVER : REQUEST_FORGET, NULL);
    }
}
