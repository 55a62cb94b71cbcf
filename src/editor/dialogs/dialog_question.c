/// Shows a question with a few answers, and takes the answer.
#include "editor/dialogs/dialog_question.h"
#include "ui/theme.h"
#include <math.h>

enum { BUTTON_WIDTH = 104 };

int question_build(struct dialog *dialog, const struct question *question)
{
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

int question_key(struct dialog *dialog, const struct question *question, int key)
{
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
