/// The dialogs: opening and saving, questions about unsaved, changed and recovered work, export, and the order in which overlays get events.
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/dialogs/state.h"
#include "rig/background.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUESTION_UNUSED = -2, QUESTION_OPEN = -1 };

/// A key's effect: an answer, QUESTION_OPEN if it moved the choice, or QUESTION_UNUSED.
static int question_key(struct dialog *dialog, int key)
{
    const struct question *question = &dialog->question;
    const int count = question->count;
    const bool back = key == KEY_LEFT || key == KEY_UP, on = key == KEY_RIGHT || key == KEY_DOWN || key == KEY_TAB;
    if (key == KEY_ESCAPE) return count - 1;
    if (key == KEY_SPACE || key == KEY_ENTER) return dialog->choice;
    if (back || on) {
        dialog->choice = (dialog->choice + (back ? count - 1 : 1)) % count;
        return QUESTION_OPEN;
    }
    for (int i = 0; i < count; i++) {
        if (question->answers[i].key == key) return i;
    }
    return QUESTION_UNUSED;
}

static void dialog_close(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    dialog->kind = DIALOG_NONE;
    dialog->awaited = REQUEST_NONE;
    dialog->after.kind = REQUEST_NONE;
}

static bool is_question(const struct dialog *dialog)
{
    return dialog->kind >= DIALOG_UNSAVED && dialog->kind <= DIALOG_ASK;
}

/// Lists a new folder and picks the names that match the text after it. Matching recent files come first unless a folder is typed.
static void dialog_match(struct dialog *dialog)
{
    char folder[UI_TEXT_SIZE];
    struct ui_filter filter = {{0}};
    const char *name = path_name(dialog->ui.text.bytes);
    snprintf(folder, sizeof folder, "%.*s", (int)(name - dialog->ui.text.bytes), dialog->ui.text.bytes);
    if (dialog->name_count < 0 || strcmp(folder, dialog->listed) != 0) {
        const struct editor_app *app = dialog->app;
        const char *at = *folder ? folder : ".";
        snprintf(dialog->listed, sizeof dialog->listed, "%s", folder);
        const int count = app->list ? app->list(app->user, at, dialog->names, DIALOG_MAX_NAMES) : 0;
        dialog->name_count = count > 0 ? count : 0;
        if (!realpath(at, dialog->folder)) dialog->folder[0] = '\0';
    }
    dialog->match_count = 0;
    dialog->choice = -1;
    // A fully selected name is about to be replaced, so everything matches.
    if (!dialog->ui.text.all) snprintf(filter.typed, sizeof filter.typed, "%s", name);
    const int recent = dialog->kind == DIALOG_OPEN && !folder[0] ? dialog->recent_count : 0;
    for (int i = 0; i < recent; i++) {
        if (ui_filter_fit(&filter, path_name(dialog->recent[i].path)) >= FIT_INSIDE)
            dialog->match[dialog->match_count++] = (struct dialog_match){.recent = &dialog->recent[i]};
    }
    for (int pass = 0; pass < 2; pass++) { // names that begin with the text, then those that hold it elsewhere
        for (int at = 0; at < dialog->name_count; at++) {
            const char *candidate = dialog->names[at];
            const enum fit fit = ui_filter_fit(&filter, candidate);
            const bool behind = background_suits(candidate) && candidate[strlen(candidate) - 1] != '/';
            if (dialog->kind == DIALOG_ADD ? path_has_end(candidate, ".json") : behind) continue;
            if (fit >= FIT_INSIDE && (fit == FIT_START) == (pass == 0))
                dialog->match[dialog->match_count++] = (struct dialog_match){.name = candidate};
        }
    }
}

/// `path` may be "".
static void dialog_open(struct dialogs *dialogs, enum dialog_kind kind, const char *path)
{
    struct dialog *dialog = &dialogs->dialog;
    dialog->kind = kind;
    dialog->awaited = REQUEST_NONE;
    dialog->error[0] = '\0';
    dialog->name_count = -1;
    dialog->choice = 0;
    ui_release(&dialog->ui);
    ui_text_set(&dialog->ui.text, path);
    dialog->ui.text.all = path[0] != '\0';
    if (is_question(dialog) || kind == DIALOG_EXPORT) return;
    bool lists = kind == DIALOG_OPEN && dialog->app->recent;
    dialog->recent_count = lists ? dialog->app->recent(dialog->app->user, dialog->recent, DIALOG_MAX_RECENT) : 0;
    dialog_match(dialog);
}

/// Carries out a request that had to wait; REQUEST_OPEN without a path asks for one.
static void dialog_go_on(struct dialogs *dialogs, const struct request *after)
{
    if (after->kind == REQUEST_OPEN && !after->path[0]) {
        dialog_open(dialogs, DIALOG_OPEN, "");
    } else if (after->kind != REQUEST_NONE) {
        core_request(dialogs->core, after);
    }
}

/// Sends a request to the app; the dialog ignores input until dialogs_answer().
static void dialog_await(struct dialogs *dialogs, enum request_kind kind, const char *path)
{
    struct request request = {
        .kind = kind, .number = dialogs->core->focus.active, .wish = dialogs->exporting.memory.wish};
    snprintf(request.path, sizeof request.path, "%s", path);
    dialogs->dialog.error[0] = '\0';
    dialogs->dialog.awaited = kind;
    core_request(dialogs->core, &request);
}

bool dialogs_ask(struct dialogs *dialogs)
{
    const struct question question = dialogs->core->question;
    if (question.count == 0 && !question.adds) return false;
    dialogs->core->question = (struct question){.count = 0};
    dialogs->dialog.question = question;
    dialog_open(dialogs, question.adds ? DIALOG_ADD : DIALOG_ASK, "");
    return true;
}

/// Asks a question of the dialogs; the caller fills in its text.
static struct question *dialog_ask(struct dialogs *dialogs, enum dialog_kind kind, const struct answer *answers,
                                   int count, void (*answered)(void *dialogs, int answer))
{
    struct question *question = &dialogs->dialog.question;
    *question = (struct question){.answers = answers, .count = count, .of = dialogs, .answered = answered};
    dialog_open(dialogs, kind, "");
    return question;
}

enum unsaved_answer { UNSAVED_SAVE, UNSAVED_DISCARD, UNSAVED_CANCEL };

static void answer_unsaved(void *of, int answer)
{
    struct dialogs *dialogs = of;
    const struct request after = dialogs->dialog.after;
    if (answer == UNSAVED_DISCARD) {
        dialog_close(dialogs);
        dialog_go_on(dialogs, &after);
    } else if (core_path(dialogs->core)[0]) {
        dialog_await(dialogs, REQUEST_SAVE, "");
    } else {
        dialogs_save_as(dialogs);
    }
}

void dialogs_leave(struct dialogs *dialogs, const struct request *after)
{
    static const struct answer answers[] = {
        {"dialog.save", "Save", 'S'}, {"dialog.discard", "Discard", 'D'}, {"dialog.cancel", "Cancel", 'C'}};
    struct core *core = dialogs->core;
    if (history_is_saved(core->history)) {
        dialog_go_on(dialogs, after);
        return;
    }
    struct question *question = dialog_ask(dialogs, DIALOG_UNSAVED, answers, 3, answer_unsaved);
    dialogs->dialog.after = *after;
    snprintf(question->title, sizeof question->title, "%s has unsaved changes", core_title(core));
    snprintf(question->note, sizeof question->note,
             "Save them, or they will be lost. S saves, D discards, Esc cancels.");
}

enum changed_answer { CHANGED_MINE, CHANGED_THEIRS, CHANGED_SAVE_AS, CHANGED_CANCEL };

static void answer_changed(void *of, int answer)
{
    struct dialogs *dialogs = of;
    if (answer == CHANGED_SAVE_AS) {
        dialogs_save_as(dialogs);
    } else {
        const enum request_kind mine = dialogs->dialog.saving ? REQUEST_OVERWRITE : REQUEST_KEEP_MINE;
        dialog_await(dialogs, answer == CHANGED_MINE ? mine : REQUEST_THEIRS, "");
    }
}

bool dialogs_ask_changed(struct dialogs *dialogs, const char *name, bool saving)
{
    static const struct answer answers[] = {{"dialog.mine", "Keep mine", 'K'},
                                            {"dialog.theirs", "Take theirs", 'T'},
                                            {"dialog.other", "Save as", 'S'},
                                            {"dialog.cancel", "Cancel", 'C'}};
    struct dialog *dialog = &dialogs->dialog;
    if (!saving && (dialogs->core->input.drag.owner || dialogs_cover(dialogs))) return false;
    struct question *question = dialog_ask(dialogs, DIALOG_CHANGED, answers, 4, answer_changed);
    snprintf(question->title, sizeof question->title, "%.255s has changed on the disk", name);
    snprintf(question->note, sizeof question->note,
             "Keep mine replaces that file %s. Take theirs opens it; undo brings yours back. Save as keeps both.",
             saving ? "now" : "at the next save");
    dialog->saving = saving;
    dialog->choice = CHANGED_SAVE_AS;
    return true;
}

enum recover_answer { RECOVER_RECOVER, RECOVER_DISCARD, RECOVER_LATER };

static void answer_recovery(void *of, int answer)
{
    dialog_await(of, answer == RECOVER_RECOVER ? REQUEST_RECOVER : REQUEST_FORGET, "");
}

void dialogs_offer_recovery(struct dialogs *dialogs, const struct recovery_offer *offer)
{
    static const struct answer answers[] = {
        {"dialog.recover", "Recover", 'R'}, {"dialog.discard", "Discard", 'D'}, {"dialog.later", "Later", 'L'}};
    char others[64] = "";
    if (offer->others > 0)
        snprintf(others, sizeof others, "  %d older one%s after this.", offer->others, offer->others > 1 ? "s" : "");
    struct question *question = dialog_ask(dialogs, DIALOG_RECOVER, answers, 3, answer_recovery);
    snprintf(question->title, sizeof question->title, "Recover unsaved work on %s?", offer->name);
    snprintf(question->note, sizeof question->note, "Last kept on %s. Later asks again at the next start.%s",
             offer->when, others);
}

enum { STEM_MORE = 32 }; ///< bytes that an extension may add
enum { LEAST_ROWS = 3, CHOICE_ROWS = 3, NUMBER_WIDTH = 72, ENDING_WIDTH = 56, NOTE_HEIGHT = 40, MAX_SIDE = 8192 };

static const char path_field[] = "export.path", clip_field[] = "export.clip";

/// Height of everything but lists and buttons.
static const float FRAME_HEIGHT = 300;

static bool is_running(const struct dialog *dialog) { return dialog->awaited == REQUEST_EXPORT; }

/// The format of a path's extension, or -1.
static int format_by_ending(const struct editor_app *app, const char *path)
{
    const struct export_format *format = export_format(path);
    return format && format - export_formats < app->format_count ? (int)(format - export_formats) : -1;
}

static bool is_listed(const struct exporting *exporting, int format)
{
    return exporting->more || !export_formats[format].is_more || format == exporting->format;
}

static const struct export_format *format_of(const struct dialogs *dialogs)
{
    return &export_formats[dialogs->exporting.format];
}

/// Replaces a path's extension by a format's; false if the path gets too long.
static bool with_ending(const struct editor_app *app, const char *path, int format, char full[PATH_LIMIT])
{
    const size_t length = strlen(path);
    const int old = format_by_ending(app, path);
    const size_t stem = old >= 0 ? length - strlen(export_formats[old].ending) : length;
    return snprintf(full, PATH_LIMIT, "%.*s%s", (int)stem, path, export_formats[format].ending) < PATH_LIMIT;
}

static void choose_format(struct dialogs *dialogs, int format)
{
    struct exporting *exporting = &dialogs->exporting;
    char full[PATH_LIMIT];
    if (with_ending(dialogs->dialog.app, exporting->memory.path, format, full))
        memcpy(exporting->memory.path, full, sizeof full);
    exporting->format = format;
    exporting->typed = 0; // reload the text into the field
    dialogs->dialog.error[0] = '\0';
}

/// An absolute path without its extension; false if it is too long.
static bool stem_of(const char *folder, const char *path, char stem[PATH_LIMIT])
{
    if (!path_resolve(folder, path, stem) || strlen(stem) >= PATH_LIMIT - STEM_MORE) return false;
    char *dot = strrchr(stem, '.'), *slash = strrchr(stem, '/');
    if (dot && dot > slash + 1) *dot = '\0';
    return true;
}

void dialogs_export(struct dialogs *dialogs)
{
    const struct core *core = dialogs->core;
    struct exporting *exporting = &dialogs->exporting;
    struct export_memory *memory = &exporting->memory;
    const struct editor_app *app = dialogs->dialog.app;
    const struct document *document = core->document;
    if (app->format_count == 0) return;
    const int last = format_by_ending(app, memory->path);
    if (last >= 0) exporting->format = last;
    const bool same =
        core_path(core)[0] ? strcmp(memory->scene, core_path(core)) == 0 : exporting->serial == core->serial;
    if (!same || !memory->path[0]) { // keeps the last format
        // Named after the scene, or else after the character, but never like that character's own file.
        char scene[PATH_LIMIT], own[PATH_LIMIT];
        const int model = document_find_rig(document, RIG_MODEL, 0);
        const bool has_model = model >= 0 && stem_of(document->folder, document->rigs[model]->model.model, own);
        const char *like = core_path(core)[0] ? core_path(core) : has_model ? own : "untitled";
        char *path = memory->path;
        snprintf(path, PATH_LIMIT, "%.*s", PATH_LIMIT - STEM_MORE, like);
        if (path_has_end(path, ".json")) path[strlen(path) - strlen(".json")] = '\0';
        if (has_model && (like == own || (stem_of(NULL, core_path(core), scene) && strcmp(scene, own) == 0)))
            strcat(path, "-animated");
        snprintf(memory->scene, sizeof memory->scene, "%s", core_path(core));
        choose_format(dialogs, exporting->format);
        memory->wish.part = false;
        memory->wish.clip[0] = '\0';
        memory->wish.rig = 0;
    }
    exporting->serial = core->serial;
    exporting->typed = 0;
    exporting->more = false;
    struct export_wish *wish = &memory->wish;
    if (!wish->part || wish->first < document->first_frame || wish->last > document->last_frame) {
        wish->part = false;
        wish->first = document->first_frame;
        wish->last = document->last_frame;
    }
    dialog_open(dialogs, DIALOG_EXPORT, "");
    dialogs->dialog.ui.focus = ui_id(&dialogs->dialog.ui, path_field);
}

void dialogs_set_export(struct dialogs *dialogs, const struct export_memory *memory)
{
    dialogs->exporting.memory = *memory;
}

static void confirm_export(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    const struct export_memory *memory = &dialogs->exporting.memory;
    if (is_running(dialog)) return;
    char full[PATH_LIMIT];
    const char *name = path_name(memory->path);
    if (!*name || *name == '.') {
        snprintf(dialog->error, sizeof dialog->error, "Type a file name.");
        return;
    }
    if (!with_ending(dialog->app, memory->path, dialogs->exporting.format, full)) {
        snprintf(dialog->error, sizeof dialog->error, "The path is too long.");
        return;
    }
    dialog_await(dialogs, REQUEST_EXPORT, full);
}

static void stop(struct dialogs *dialogs)
{
    if (is_running(&dialogs->dialog)) {
        core_request(dialogs->core, &(struct request){.kind = REQUEST_EXPORT_STOP});
    } else {
        dialog_close(dialogs);
    }
}

/// The Export dialog's keys; true if used. They also arrive while the app is busy.
static bool export_key(struct dialogs *dialogs, int key)
{
    const struct ui *ui = &dialogs->dialog.ui;
    const bool in_text = ui->focus == ui_id(ui, path_field) || ui->focus == ui_id(ui, clip_field);
    const int count = dialogs->dialog.app->format_count, way = key == KEY_UP ? -1 : 1;
    if (key == KEY_ESCAPE && !ui->typing && !ui->held) {
        stop(dialogs);
    } else if (is_running(&dialogs->dialog)) {
        return key != KEY_ENTER && key != KEY_SPACE; // Enter and Space press the button
    } else if (key == KEY_ENTER && in_text) {
        confirm_export(dialogs);
    } else if ((key == KEY_UP || key == KEY_DOWN) && in_text) {
        int next = dialogs->exporting.format + way;
        while (next >= 0 && next < count && !is_listed(&dialogs->exporting, next)) next += way;
        if (next >= 0 && next < count) choose_format(dialogs, next);
    } else {
        return false;
    }
    return true;
}

/// A text field that keeps its content while another one has the focus.
static bool build_text(struct dialogs *dialogs, struct rect r, const char *name, char *text, size_t size)
{
    struct exporting *exporting = &dialogs->exporting;
    struct ui *ui = &dialogs->dialog.ui;
    const uint32_t id = ui_id(ui, name);
    const struct ui_text others = ui->text;
    if (exporting->typed == id && ui->focus != id) exporting->typed = 0;
    if (exporting->typed != id) ui_text_set(&ui->text, text);
    if (exporting->typed != id && ui->focus == id) ui->text.all = true; // focused by Tab or on opening
    const bool changed = ui_text_field(ui, r, name);
    if (changed) {
        snprintf(text, size, "%.*s", name_fit(ui->text.bytes, size - 1), ui->text.bytes);
        dialogs->dialog.error[0] = '\0';
    }
    if (ui->focus == id) {
        exporting->typed = id;
    } else {
        ui->text = others;
    }
    return changed;
}

/// A whole-number field.
static bool build_number(struct dialogs *dialogs, struct rect r, struct ui_number number, double *value)
{
    number.step = 1;
    number.fallback = NAN;
    if (ui_value(&dialogs->dialog.ui, r, &number, value) == UI_NONE) return false;
    *value = round(*value);
    return true;
}

static struct rect labelled(struct ui *ui, struct rect *row, float width, const char *label)
{
    const struct rect r = {row->x, row->y, UI_LABEL, row->h},
                      field = {row->x + UI_LABEL + UI_GAP, row->y, width, row->h};
    ui_label(ui, r, label, theme()->text_dim);
    row->x += UI_LABEL + width + 3 * UI_GAP;
    row->w -= UI_LABEL + width + 3 * UI_GAP;
    return field;
}

/// The second of two number fields, with a word between.
static struct rect second(struct ui *ui, struct rect first, const char *word)
{
    const float x = first.x + first.w + UI_GAP;
    ui_label(ui, (struct rect){x, first.y, 16, first.h}, word, theme()->text_dim);
    return (struct rect){x + 16 + UI_GAP, first.y, first.w, first.h};
}

static const float PAIR_WIDTH = 2 * NUMBER_WIDTH + 16 + 2 * UI_GAP;

static bool is_offered(const struct rig *rig, unsigned choices)
{
    if (choices & CHOICE_JOINTS) return rig->kind == RIG_TAIL || rig->kind == RIG_MODEL;
    return rig->kind != RIG_CHAIN; // exported with its character
}

/// The offered rig that follows the one with an id (0: the first); NULL after the last.
static const struct rig *next_rig(const struct document *document, unsigned choices, unsigned id)
{
    bool follows = id == 0;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        if (follows && is_offered(rig, choices)) return rig;
        follows |= rig->id == id;
    }
    return NULL;
}

static void build_toggle(struct ui *ui, struct rect *row, const char *name, const char *label, bool *on)
{
    enum { TOGGLE = 28, WORDS = 140 };
    ui_toggle(ui, *row, name, on);
    ui_label(ui, (struct rect){row->x + TOGGLE + UI_GAP, row->y, WORDS, row->h}, label, theme()->text_dim);
    row->x += TOGGLE + WORDS + 2 * UI_GAP;
}

/// Has the same number of rows for every format, so that nothing jumps.
static void build_choices(struct dialogs *dialogs, const struct document *document)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    struct ui *ui = &dialogs->dialog.ui;
    const struct export_format *format = format_of(dialogs);
    const bool narrow = ui->area.w < 480; // one choice a row
    struct rect rows[CHOICE_ROWS + 2] = {ui_row(ui, UI_ROW)};
    for (int i = 1; i < CHOICE_ROWS + 2 * narrow; i++) rows[i] = ui_row(ui, UI_ROW);

    const double start = document->first_frame, end = document->last_frame;
    struct rect pair = labelled(ui, &rows[0], PAIR_WIDTH, "frames");
    pair.w = NUMBER_WIDTH;
    const struct ui_number first = {.name = "export.first", .lowest = start, .highest = wish->last};
    bool changed = build_number(dialogs, pair, first, &wish->first);
    const struct ui_number last = {.name = "export.last", .lowest = wish->first, .highest = end};
    changed |= build_number(dialogs, second(ui, pair, "to"), last, &wish->last);
    if (changed) wish->part = wish->first > start || wish->last < end;
    if (format->choices & CHOICE_KEYS) {
        double keys = wish->keys > 0 ? wish->keys : document->substeps;
        const struct rect r = labelled(ui, &rows[narrow ? CHOICE_ROWS : 0], NUMBER_WIDTH, "keys a frame");
        const struct ui_number number = {.name = "export.keys", .lowest = 1, .highest = SCENE_MAX_SUBSTEPS};
        if (build_number(dialogs, r, number, &keys)) wish->keys = (int)keys;
    }
    if (format->choices & CHOICE_SIZE) {
        double width = wish->width > 0 ? wish->width : format->width;
        double height = wish->height > 0 ? wish->height : format->height;
        pair = labelled(ui, &rows[1], PAIR_WIDTH, "size");
        pair.w = NUMBER_WIDTH;
        const struct ui_number across = {.name = "export.width", .lowest = 16, .highest = MAX_SIDE};
        const struct ui_number up = {.name = "export.height", .lowest = 16, .highest = MAX_SIDE};
        changed = build_number(dialogs, pair, across, &width);
        changed |= build_number(dialogs, second(ui, pair, "×"), up, &height);
        if (changed) wish->width = (int)width, wish->height = (int)height;
    }
    if (format->choices & CHOICE_CLIP) {
        const struct rect r = labelled(ui, &rows[1], PAIR_WIDTH, "clip");
        build_text(dialogs, (struct rect){r.x, r.y + 2, r.w, r.h - 4}, clip_field, wish->clip, sizeof wish->clip);
        const int rig = document_next_rig(document, RIG_MODEL, -1);
        const char *usual = rig >= 0 ? document->rigs[rig]->model.clip : NULL; // of a character
        if (!wish->clip[0] && ui->focus != ui_id(ui, clip_field))
            ui_label(ui, (struct rect){r.x + 8, r.y, r.w - 16, r.h}, usual ? usual : "as the scene",
                     theme()->text_dim);
    }
    if (format->choices & CHOICE_RIG) {
        const bool needs_one = format->choices & CHOICE_ONE;
        const struct rig *top = next_rig(document, format->choices, 0), *chosen = top;
        const bool several = top && next_rig(document, format->choices, top->id);
        while (chosen && chosen->id != wish->rig) chosen = next_rig(document, format->choices, chosen->id);
        if (!chosen && needs_one && several) chosen = top;
        wish->rig = chosen ? chosen->id : 0; // the rig belonged to another format or is gone
        if (several) {
            const struct rect r = labelled(ui, &rows[narrow ? CHOICE_ROWS + 1 : 1], NUMBER_WIDTH + 48, "rig");
            const char *label = !chosen ? "all rigs" : chosen->name ? chosen->name : rig_word(chosen->kind);
            if (ui_button(ui, r, "export.rig", label, false)) {
                const struct rig *next = next_rig(document, format->choices, wish->rig);
                if (!next && needs_one) next = top;
                wish->rig = next ? next->id : 0; // all after the last, where the format allows that
            }
        }
    }

    struct rect *row = &rows[2];
    bool morphs = false;
    for (int r = -1; (r = document_next_rig(document, RIG_MODEL, r)) >= 0;)
        morphs |= document->rigs[r]->model.drive_count > 0;
    if ((format->choices & CHOICE_CLIPS) && document_find_rig(document, RIG_CHAIN, 0) >= 0)
        build_toggle(ui, row, "export.clips", "all clips", &wish->all_clips);
    if ((format->choices & CHOICE_SIGNED) && morphs)
        build_toggle(ui, row, "export.signed", "signed morph targets", &wish->is_signed);
    if (format->choices & CHOICE_ALPHA)
        build_toggle(ui, row, "export.transparent", "transparent", &wish->transparent);
}

static void build_note(struct dialogs *dialogs, const struct document *document)
{
    const struct dialog *dialog = &dialogs->dialog;
    const struct figures *now = dialog->app->figures;
    const struct export_wish *wish = &dialogs->exporting.memory.wish;
    const struct export_format *format = format_of(dialogs);
    struct ui *ui = &dialogs->dialog.ui;
    const float top = ui->y;
    char text[160];
    if (is_running(dialog)) {
        snprintf(text, sizeof text,
                 now->total > 0 ? "%ld of %ld. Esc cancels and leaves nothing behind."
                                : "Getting ready. Esc cancels and leaves nothing behind.",
                 now->done, now->total);
        const struct rect bar = ui_row(ui, 8);
        const float part = now->total > 0 ? (float)now->done / (float)now->total : 0;
        if (ui->pass == UI_PASS_DRAW) {
            drawlist_rounded(ui->list, bar, 4, theme()->fill);
            drawlist_rounded(ui->list, (struct rect){bar.x, bar.y, fmaxf(8, bar.w * part), bar.h}, 4,
                             theme()->accent);
        }
        ui_space(ui, 4);
    } else {
        const int keys = wish->keys > 0 ? wish->keys : document->substeps;
        const double frames = wish->last - wish->first;
        double rate = format->film ? 0 : document->fps * keys;
        const double count = format->film ? export_pictures(format, document, frames, 0, &rate) : frames * keys + 1;
        snprintf(text, sizeof text, "%.0f %s%s, %g a second. ↑ ↓ choose the format, Tab goes to the choices.", count,
                 format->film ? "picture" : "key", count == 1 ? "" : "s", rate);
    }
    ui_paragraph(ui,
                 dialog->error[0]   ? dialog->error
                 : ui->complaint[0] ? ui->complaint
                                    : text,
                 dialog->error[0] || ui->complaint[0] ? theme()->error : theme()->text_dim);
    ui_space(ui, fmaxf(8, NOTE_HEIGHT - (ui->y - top)));
}

static void export_build(struct dialogs *dialogs)
{
    struct core *core = dialogs->core;
    enum { CANCEL_WIDTH = 104, WRITE_WIDTH = 240 };
    struct exporting *exporting = &dialogs->exporting;
    struct export_memory *memory = &exporting->memory;
    const struct editor_app *app = dialogs->dialog.app;
    struct ui *ui = &dialogs->dialog.ui;
    if (is_running(&dialogs->dialog)) {
        char title[96];
        snprintf(title, sizeof title, "Writing %.80s", path_name(memory->path));
        ui_label(ui, ui_row(ui, UI_ROW), title, theme()->text);
        ui_space(ui, 4);
    } else {
        ui_label(ui, ui_row(ui, UI_ROW), "Export the motion", theme()->text);
        ui_space(ui, 4);
        if (build_text(dialogs, ui_row(ui, 28), path_field, memory->path, PATH_LIMIT)) {
            const int format = format_by_ending(app, memory->path);
            if (format >= 0) exporting->format = format;
        }
        ui_space(ui, 8);
        int most = !exporting->more, place = 0; // rows of the list, the chosen one's
        for (int f = 0; f < app->format_count; f++) {
            most += is_listed(exporting, f);
            place += f < exporting->format && is_listed(exporting, f);
        }
        const int fitting = (int)((core->view.layout.window.h - FRAME_HEIGHT) / UI_ROW);
        const int rows = fitting < LEAST_ROWS ? LEAST_ROWS : fitting > most ? most : fitting;
        const struct rect view = {ui->area.x, ui->y, ui->area.w, (float)rows * UI_ROW};
        int taken = -1;
        ui_list_fit(&exporting->formats, view.h, (float)most * UI_ROW);
        if (ui->focus == ui_id(ui, path_field)) // shows the format being typed
            ui_list_show(&exporting->formats, (float)place * UI_ROW, UI_ROW);
        ui_list_begin(ui, &exporting->formats, view);
        for (int f = 0; f < app->format_count; f++) {
            if (!is_listed(exporting, f)) continue;
            char name[32];
            const struct rect r = ui_row(ui, UI_ROW);
            const float left = r.x + 6 + ENDING_WIDTH;
            snprintf(name, sizeof name, "export%s", export_formats[f].ending);
            if (ui_list_row(ui, r, name, "", 0, f == exporting->format)) taken = f;
            ui_label(ui, (struct rect){r.x + 6, r.y, ENDING_WIDTH, r.h}, export_formats[f].ending, theme()->text);
            ui_label(ui, (struct rect){left, r.y, r.w - 12 - ENDING_WIDTH, r.h}, export_formats[f].use,
                     theme()->text_dim);
        }
        if (!exporting->more && ui_list_row(ui, ui_row(ui, UI_ROW), "export.more", "More formats", 0, false)) {
            exporting->more = true;
            ui->focus = ui_id(ui, path_field); // where arrows choose
        }
        ui_list_end(ui);
        if (taken >= 0) choose_format(dialogs, taken);
        ui_space(ui, 8);
        build_choices(dialogs, core->document);
        ui_space(ui, 4);
    }
    build_note(dialogs, core->document);

    const bool running = is_running(&dialogs->dialog);
    char label[64], full[PATH_LIMIT] = "";
    const struct rect row = ui_row(ui, 28);
    const float width = fminf(WRITE_WIDTH, row.w - CANCEL_WIDTH - UI_GAP);
    const struct rect right = {row.x + row.w - width, row.y, width, row.h};
    const float end = running ? row.x + row.w : right.x - UI_GAP;
    const struct rect left = {end - CANCEL_WIDTH, row.y, CANCEL_WIDTH, row.h};
    with_ending(app, memory->path, exporting->format, full);
    snprintf(label, sizeof label, "Write %.48s", path_name(full));
    const bool stopped = ui_button(ui, left, "dialog.cancel", "Cancel", false);
    if (!running && ui_button(ui, right, "dialog.confirm", label, true)) confirm_export(dialogs);
    if (stopped) stop(dialogs);
}

enum { LIST_ROWS = 8, AROUND_LIST = 184, BUTTON_WIDTH = 104 };

static bool begins(const struct dialog *dialog, const char *name)
{
    const char *typed = path_name(dialog->ui.text.bytes);
    return strncmp(name, typed, strlen(typed)) == 0;
}

void dialogs_save_as(struct dialogs *dialogs)
{
    const struct core *core = dialogs->core;
    const char *name = path_has_end(core_title(core), ".json") ? core_title(core) : "untitled.json";
    dialog_open(dialogs, DIALOG_SAVE_AS, core_path(core)[0] ? core_path(core) : name);
}

bool dialogs_answer(struct dialogs *dialogs, const struct request *request, bool ok, const char *text)
{
    struct dialog *dialog = &dialogs->dialog;
    if (dialog->awaited == REQUEST_NONE || dialog->awaited != request->kind) return false;
    dialog->awaited = REQUEST_NONE;
    if (ok) {
        struct request after = dialog->after;
        dialog_close(dialogs);
        dialog_go_on(dialogs, &after);
    } else {
        snprintf(dialog->error, sizeof dialog->error, "%s", text);
        core_drop_home(dialogs->core, dialog->error);
    }
    return true;
}

static void confirm(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    char path[sizeof((struct request *)0)->path];
    const char *typed = dialog->ui.text.bytes;
    bool saving = dialog->kind == DIALOG_SAVE_AS;
    if (is_question(dialog)) return;
    if (!*path_name(typed) && !(dialog->kind == DIALOG_ADD && *typed)) { // a folder of pictures may be added
        snprintf(dialog->error, sizeof dialog->error, "Type a file name.");
        return;
    }
    int length = snprintf(path, sizeof path, "%s%s", typed, saving && !path_has_end(typed, ".json") ? ".json" : "");
    if (length >= (int)sizeof path) {
        snprintf(dialog->error, sizeof dialog->error, "The path is too long.");
        return;
    }
    dialog_await(dialogs, saving ? REQUEST_SAVE_AS : dialog->kind == DIALOG_ADD ? REQUEST_ADD : REQUEST_OPEN, path);
}

static void answer(struct dialogs *dialogs, int given)
{
    const struct dialog *dialog = &dialogs->dialog;
    const struct question question = dialog->question;
    const bool changes = given + 1 < question.count;
    if (given < 0) return;
    if (!changes || dialog->kind == DIALOG_ASK) dialog_close(dialogs);
    if (changes) question.answered(question.of, given);
}

static void move_choice(struct dialog *dialog, int direction)
{
    if (dialog->match_count == 0) return;
    int next = dialog->choice + direction;
    dialog->choice = next < 0 ? 0 : next >= dialog->match_count ? dialog->match_count - 1 : next;
}

static void set_name(struct dialog *dialog, const char *name, size_t length)
{
    char path[UI_TEXT_SIZE];
    int folder = (int)(path_name(dialog->ui.text.bytes) - dialog->ui.text.bytes);
    snprintf(path, sizeof path, "%.*s%.*s", folder, dialog->ui.text.bytes, (int)length, name);
    ui_text_set(&dialog->ui.text, path);
    dialog_match(dialog);
}

/// Tab: completes up to where the matching names differ.
static void dialog_complete(struct dialog *dialog)
{
    const char *first = NULL;
    size_t common = 0;
    for (int m = 0; m < dialog->match_count; m++) {
        const char *other = dialog->match[m].name;
        size_t same = 0;
        if (!other || (!dialog->ui.text.all && !begins(dialog, other))) continue;
        if (!first) common = strlen(first = other);
        while (same < common && other[same] == first[same]) same++;
        common = same;
    }
    while (first && common > 0 && ((unsigned char)first[common] & 0xC0) == 0x80) common--; // never split a character
    if (first && (common > 0 || dialog->ui.text.all)) set_name(dialog, first, common);
}

/// Puts a match into the path. true for a file; a folder is listed, a missing file reported.
static bool dialog_take(struct dialog *dialog, int match)
{
    const struct dialog_recent *recent = dialog->match[match].recent;
    if (recent && recent->missing) {
        snprintf(dialog->error, sizeof dialog->error, "%.300s no longer exists.", recent->path);
        return false;
    }
    if (recent) {
        ui_text_set(&dialog->ui.text, recent->path);
        dialog_match(dialog);
        return true;
    }
    const char *name = dialog->match[match].name;
    size_t length = strlen(name);
    bool folder = length > 0 && name[length - 1] == '/';
    set_name(dialog, name, length);
    return !folder;
}

static bool path_key(struct dialogs *dialogs, int key)
{
    struct dialog *dialog = &dialogs->dialog;
    if (key == KEY_ESCAPE) {
        dialog_close(dialogs);
    } else if (key == KEY_TAB) {
        dialog_complete(dialog);
    } else if (key == KEY_UP || key == KEY_DOWN) {
        move_choice(dialog, key == KEY_UP ? -1 : 1);
    } else if (key == KEY_ENTER) {
        const char *only = dialog->match_count == 1 ? dialog->match[0].name : NULL;
        if (dialog->choice < 0 && dialog->kind != DIALOG_SAVE_AS && only && begins(dialog, only))
            dialog->choice = 0; // the only match, if it begins with the text
        if (dialog->choice < 0 || dialog_take(dialog, dialog->choice)) confirm(dialogs);
    } else {
        return false;
    }
    return true;
}

static void build_list(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    const int rows = (int)fminf(LIST_ROWS, fmaxf((dialogs->core->view.layout.window.h - AROUND_LIST) / UI_ROW, 1));
    struct rect list = {ui->area.x, ui->y, ui->area.w, (float)rows * UI_ROW};
    const struct event *event = ui->event;
    const bool twice = ui->pass == UI_PASS_EVENT && event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                       event->button == BUTTON_LEFT && event->clicks == 2;
    const bool confirmed = twice && rect_contains(list, event->x, event->y) && *path_name(ui->text.bytes);
    struct ui_list matches = {.view = (float)rows, .content = (float)dialog->match_count};
    ui_list_show(&matches, (float)dialog->choice, 1);
    const int first = (int)fmaxf(matches.offset, 0);
    int taken = -1;
    for (int row = 0; row < rows; row++) {
        struct rect r = ui_row(ui, UI_ROW);
        const int match = first + row;
        if (match < dialog->match_count) {
            char name[32];
            const struct dialog_recent *recent = dialog->match[match].recent;
            const char *text = recent ? "" : dialog->match[match].name;
            snprintf(name, sizeof name, "dialog.match.%d", match);
            if (ui_list_row(ui, r, name, text, 0, match == dialog->choice)) taken = match;
            if (recent) { // its name, with its folder to the right
                const char *slash = strrchr(recent->path, '/');
                const int length = !slash ? 0 : slash > recent->path ? (int)(slash - recent->path) : 1;
                const float half = floorf(r.w * 0.45f);
                char folder[PATH_LIMIT];
                snprintf(folder, sizeof folder, "%.*s", length, recent->path);
                core_drop_home(dialogs->core, folder);
                ui_label(ui, (struct rect){r.x + 6, r.y, half - 6, r.h}, path_name(recent->path),
                         recent->missing ? theme()->text_dim : theme()->text);
                ui_label_right(ui, (struct rect){r.x + half + UI_GAP, r.y, r.w - half - UI_GAP - 6, r.h},
                               recent->missing ? "no longer exists" : folder, theme()->text_dim);
            }
        }
        if (row == 0 && dialog->match_count == 0) {
            char text[PATH_MAX + 32] = "Nothing matches.";
            if (dialog->kind == DIALOG_SAVE_AS)
                snprintf(text, sizeof text, dialog->folder[0] ? "A new file in %s." : "There is no such folder.",
                         dialog->app->in_page ? "this browser" : dialog->folder);
            ui_label(ui, (struct rect){r.x + 6, r.y, r.w - 12, r.h}, text, theme()->text_dim);
        }
    }
    if (taken >= 0) dialog->error[0] = '\0';
    bool direct = taken >= 0 && dialog->match[taken].recent; // one click opens a recent file
    bool done = taken >= 0 && !confirmed && dialog_take(dialog, taken);
    if (confirmed || (done && direct)) confirm(dialogs);
}

static void build_path(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    bool saving = dialog->kind == DIALOG_SAVE_AS, adding = dialog->kind == DIALOG_ADD;
    const char *title = saving   ? "Save the scene as"
                        : adding ? "Add a character or model; a picture, film or folder of pictures goes behind"
                                 : "Open a scene or character";
    ui_label(ui, ui_row(ui, UI_ROW), title, theme()->text);
    ui_space(ui, 4);
    if (ui_text_field(ui, ui_row(ui, 28), "dialog.path")) {
        dialog->error[0] = '\0';
        dialog_match(dialog);
    }
    ui_space(ui, 8);
    if (dialog->app->list) build_list(dialogs);
    const char *note = "", *typed = path_name(ui->text.bytes);
    for (int m = 0; saving && m < dialog->match_count; m++) {
        if (strcmp(dialog->match[m].name, typed) == 0) note = "This replaces an existing file.";
    }
    if (dialog->match_count > 0 && dialog->match[0].recent)
        note = "Recent files come first. Type a path or choose one; Tab completes.";
    if (!note[0] && dialog->app->list) note = "Tab completes, arrow keys choose.";
    ui_space(ui, 4);
    float top = ui->y;
    ui_paragraph(ui, dialog->error[0] ? dialog->error : note, dialog->error[0] ? theme()->error : theme()->text_dim);
    ui_space(ui, fmaxf(8, 40 - (ui->y - top)));
    struct rect row = ui_row(ui, 28);
    struct rect right = {row.x + row.w - BUTTON_WIDTH, row.y, BUTTON_WIDTH, row.h};
    struct rect left = {right.x - UI_GAP - BUTTON_WIDTH, row.y, BUTTON_WIDTH, row.h};
    bool cancelled = ui_button(ui, left, "dialog.cancel", "Cancel", false);
    if (ui_button(ui, right, "dialog.confirm", saving ? "Save" : adding ? "Add" : "Open", true)) confirm(dialogs);
    if (cancelled) dialog_close(dialogs);
}

static void build(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    ui_space(ui, 8);
    if (is_question(dialog)) {
        const struct question *question = &dialog->question;
        const bool failed = dialog->error[0] != '\0';
        ui_label(ui, ui_row(ui, UI_ROW), question->title, theme()->text);
        const float top = ui->y;
        ui_paragraph(ui, failed ? dialog->error : question->note, failed ? theme()->error : theme()->text_dim);
        ui_space(ui, fmaxf(8, 40 - (ui->y - top)));
        const struct rect row = ui_row(ui, 28);
        const float fitting = floorf((row.w + UI_GAP) / (float)question->count) - UI_GAP;
        const float width = fminf(BUTTON_WIDTH, fitting);
        int pressed = QUESTION_OPEN;
        for (int i = 0; i < question->count; i++) {
            const float x = row.x + row.w - (float)(question->count - i) * (width + UI_GAP) + UI_GAP;
            const struct answer *offered = &question->answers[i];
            const struct rect r = {x, row.y, width, row.h};
            if (ui_button(ui, r, offered->name, offered->label, i == dialog->choice)) pressed = i;
        }
        answer(dialogs, pressed);
    } else if (dialog->kind == DIALOG_EXPORT) {
        export_build(dialogs);
    } else {
        ui->focus = ui_id(ui, "dialog.path"); // the path is the only text field
        build_path(dialogs);
    }
    ui_space(ui, 12);
}

/// Centred, as high as its content.
static struct rect dialog_box(struct dialogs *dialogs)
{
    struct rect window = dialogs->core->view.layout.window;
    struct ui *ui = &dialogs->dialog.ui;
    const bool narrow = is_question(&dialogs->dialog) && dialogs->dialog.question.count < 4;
    float w = fminf(narrow ? 440 : 560, window.w - 16);
    ui_begin_find(ui, (struct rect){0, 0, w, window.h}, "", NULL);
    build(dialogs);
    float h = fminf(ui->y, window.h - 16);
    ui_end(ui);
    return (struct rect){roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 3), w, h};
}

/// true for every event while a dialog is open, except EVENT_SIZE and EVENT_EXPOSE.
static bool dialog_event(struct dialogs *dialogs, const struct event *event)
{
    struct dialog *dialog = &dialogs->dialog;
    if (dialog->kind == DIALOG_NONE || event->kind == EVENT_SIZE || event->kind == EVENT_EXPOSE) return false;
    if (dialog->kind == DIALOG_RECOVER && event->kind == EVENT_CLOSE && dialog->awaited == REQUEST_NONE) {
        dialog_close(dialogs);
        return false;
    }
    bool key = event->kind == EVENT_KEY;
    if (key && event->action == ACTION_RELEASE) return false; // the key was pressed before the dialog opened
    bool typed_by_answer = dialog->skip_text && event->kind == EVENT_TEXT;
    dialog->skip_text = false;
    const bool exports = dialog->kind == DIALOG_EXPORT;
    if ((dialog->awaited != REQUEST_NONE && !exports) || typed_by_answer) return true;
    bool chord = event->mods & (MOD_CTRL | MOD_ALT | MOD_SUPER);
    if (key && !chord) {
        if (is_question(dialog)) {
            const int given = question_key(dialog, event->key);
            dialog->skip_text = given != QUESTION_UNUSED; // an answer's letter also arrives as text
            answer(dialogs, given);
            if (given != QUESTION_UNUSED) return true;
        } else if (exports ? export_key(dialogs, event->key) : path_key(dialogs, event->key)) {
            return true;
        }
    }
    if (event->kind == EVENT_WHEEL && !is_question(dialog) && !exports) move_choice(dialog, event->dy > 0 ? -3 : 3);
    struct rect box = dialog_box(dialogs);
    ui_begin_event(&dialog->ui, box, event);
    build(dialogs);
    ui_end(&dialog->ui);
    return true;
}

struct dialogs *dialogs_create(struct core *core, const struct command *commands, int count)
{
    struct dialogs *dialogs = need_zeroed(1, sizeof *dialogs);
    dialogs->core = core;
    dialogs->dialog.app = &core->app;
    dialogs->commands = commands;
    dialogs->command_count = count;
    return dialogs;
}

void dialogs_destroy(struct dialogs *dialogs) { free(dialogs); }

bool dialogs_event(struct dialogs *dialogs, const struct event *event)
{
    return dialog_event(dialogs, event) || lookup_event(dialogs, event) || welcome_event(dialogs, event);
}

void dialogs_show(struct dialogs *dialogs)
{
    struct core *core = dialogs->core;
    lookup_show(dialogs);
    if (dialogs->dialog.kind == DIALOG_NONE) return;
    struct drawlist *list = &core->list;
    const struct rect box = dialog_box(dialogs);
    drawlist_rect(list, core->view.layout.window, theme()->veil);
    drawlist_rounded(list, box, 8, theme()->panel);
    drawlist_rounded_line(list, box, 8, 1, theme()->zero);
    ui_begin_draw(&dialogs->dialog.ui, box, list);
    build(dialogs);
    ui_end(&dialogs->dialog.ui);
}

bool dialogs_are_asking(const struct dialogs *dialogs) { return dialogs->dialog.kind != DIALOG_NONE; }

bool dialogs_cover(const struct dialogs *dialogs) { return dialogs_are_asking(dialogs) || dialogs->lookup.kind; }

enum ui_over dialogs_over(const struct dialogs *dialogs)
{
    return dialogs_are_asking(dialogs) ? dialogs->dialog.ui.over : UI_OVER_NOTHING;
}
