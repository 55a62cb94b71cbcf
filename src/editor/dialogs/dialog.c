/// The dialogs for opening and saving, and the order in which overlays get events.
#include "base/file.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/dialogs/state.h"
#include "ui/filter.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LIST_ROWS = 8, AROUND_LIST = 184, BUTTON_WIDTH = 104 };

static bool is_question(const struct dialog *dialog)
{
    return dialog->kind >= DIALOG_UNSAVED && dialog->kind <= DIALOG_ASK;
}

static void list_folder(struct dialog *dialog, const char *folder)
{
    if (dialog->name_count >= 0 && strcmp(folder, dialog->listed) == 0) return;
    snprintf(dialog->listed, sizeof dialog->listed, "%s", folder);
    dialog->name_count = 0;
    if (!dialog->files.list) return;
    int count = dialog->files.list(dialog->files.user, *folder ? folder : ".", dialog->names, DIALOG_MAX_NAMES);
    dialog->name_count = count > 0 ? count : 0;
}

static bool begins(const struct dialog *dialog, const char *name)
{
    const char *typed = path_name(dialog->ui.text.bytes);
    return strncmp(name, typed, strlen(typed)) == 0;
}

/// Pass 0 takes names that begin with the text, pass 1 those that hold it elsewhere.
static bool fits(const struct dialog *dialog, const struct ui_filter *filter, const char *name, int pass)
{
    const enum fit fit = ui_filter_fit(filter, name);
    if (dialog->kind == DIALOG_ADD && path_has_end(name, ".json")) return false;
    return fit >= FIT_INSIDE && (fit == FIT_START) == (pass == 0);
}

/// Lists a new folder and picks the names that match the text after it. Matching recent files come first unless a folder is typed.
static void dialog_match(struct dialog *dialog)
{
    char folder[UI_TEXT_SIZE];
    struct ui_filter filter = {{0}};
    const char *name = path_name(dialog->ui.text.bytes);
    snprintf(folder, sizeof folder, "%.*s", (int)(name - dialog->ui.text.bytes), dialog->ui.text.bytes);
    list_folder(dialog, folder);
    dialog->match_count = 0;
    dialog->choice = -1;
    // A fully selected name is about to be replaced, so everything matches.
    if (!dialog->ui.text.all) snprintf(filter.typed, sizeof filter.typed, "%s", name);
    const int recent = dialog->kind == DIALOG_OPEN && !folder[0] ? dialog->recent_count : 0;
    for (int i = 0; i < recent; i++) {
        if (ui_filter_fit(&filter, path_name(dialog->recent[i].path)) >= FIT_INSIDE)
            dialog->match[dialog->match_count++] = DIALOG_MAX_NAMES + i;
    }
    for (int i = 0; i < 2 * dialog->name_count; i++) {
        const int at = i % dialog->name_count;
        if (fits(dialog, &filter, dialog->names[at], i / dialog->name_count))
            dialog->match[dialog->match_count++] = at;
    }
}

void dialog_open(struct dialogs *dialogs, enum dialog_kind kind, const char *path)
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
    bool lists = kind == DIALOG_OPEN && dialog->files.recent;
    dialog->recent_count = lists ? dialog->files.recent(dialog->files.user, dialog->recent, DIALOG_MAX_RECENT) : 0;
    dialog_match(dialog);
}

void dialog_close(struct dialogs *dialogs)
{
    struct dialog *dialog = &dialogs->dialog;
    dialog->kind = DIALOG_NONE;
    dialog->awaited = REQUEST_NONE;
    dialog->after.kind = REQUEST_NONE;
}

void dialogs_save_as(struct dialogs *dialogs, const struct core *core)
{
    const char *name = path_has_end(core->title, ".json") ? core->title : "untitled.json";
    dialog_open(dialogs, DIALOG_SAVE_AS, core->path[0] ? core->path : name);
}

void dialog_go_on(struct dialogs *dialogs, struct core *core, const struct request *after)
{
    if (after->kind == REQUEST_OPEN && !after->path[0]) {
        dialog_open(dialogs, DIALOG_OPEN, "");
    } else if (after->kind != REQUEST_NONE) {
        core->request = *after;
    }
}

void dialog_await(struct dialogs *dialogs, struct core *core, enum request_kind kind, const char *path)
{
    dialogs->dialog.error[0] = '\0';
    dialogs->dialog.awaited = kind;
    core_request(core, kind, path);
}

bool dialogs_answer(struct dialogs *dialogs, struct core *core, const struct request *request, bool ok,
                    const char *text)
{
    struct dialog *dialog = &dialogs->dialog;
    if (dialog->awaited == REQUEST_NONE || dialog->awaited != request->kind) return false;
    dialog->awaited = REQUEST_NONE;
    if (ok) {
        struct request after = dialog->after;
        dialog_close(dialogs);
        dialog_go_on(dialogs, core, &after);
    } else {
        snprintf(dialog->error, sizeof dialog->error, "%s", text);
    }
    return true;
}

static void confirm(struct dialogs *dialogs, struct core *core)
{
    struct dialog *dialog = &dialogs->dialog;
    char path[sizeof((struct request *)0)->path];
    const char *typed = dialog->ui.text.bytes;
    bool saving = dialog->kind == DIALOG_SAVE_AS;
    if (is_question(dialog)) return;
    if (!*path_name(typed)) {
        snprintf(dialog->error, sizeof dialog->error, "Type a file name.");
        return;
    }
    int length = snprintf(path, sizeof path, "%s%s", typed, saving && !path_has_end(typed, ".json") ? ".json" : "");
    if (length >= (int)sizeof path) {
        snprintf(dialog->error, sizeof dialog->error, "The path is too long.");
        return;
    }
    dialog_await(dialogs, core,
                 saving                       ? REQUEST_SAVE_AS
                 : dialog->kind == DIALOG_ADD ? REQUEST_ADD
                                              : REQUEST_OPEN,
                 path);
}

static void answer(struct dialogs *dialogs, struct core *core, int given)
{
    const struct dialog *dialog = &dialogs->dialog;
    void (*const answered)(void *, struct core *, int) = dialog->question.answered;
    const bool changes = given + 1 < dialog->question.count;
    if (given < 0) return;
    if (!changes || dialog->kind == DIALOG_ASK) dialog_close(dialogs);
    if (changes) answered(dialogs, core, given);
}

/// An answer's letter also arrives as text; skip_text keeps it out of a path.
static bool question_event(struct dialogs *dialogs, struct core *core, int key)
{
    int given = question_key(&dialogs->dialog, key);
    if (given == QUESTION_UNUSED) return false;
    dialogs->dialog.skip_text = true;
    answer(dialogs, core, given);
    return true;
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

/// The recent file of a match, or NULL.
static const struct dialog_recent *dialog_recent_of(const struct dialog *dialog, int match)
{
    int recent = dialog->match[match] - DIALOG_MAX_NAMES;
    return recent >= 0 ? &dialog->recent[recent] : NULL;
}

/// Tab: completes up to where the matching names differ.
static void dialog_complete(struct dialog *dialog)
{
    const char *first = NULL;
    size_t common = 0;
    for (int m = 0; m < dialog->match_count; m++) {
        const char *other = dialog_recent_of(dialog, m) ? "" : dialog->names[dialog->match[m]];
        size_t same = 0;
        if (!*other || (!dialog->ui.text.all && !begins(dialog, other))) continue;
        if (!first) common = strlen(first = other);
        while (same < common && other[same] == first[same]) same++;
        common = same;
    }
    while (first && common > 0 && ((unsigned char)first[common] & 0xC0) == 0x80) common--; // never split a character
    if (first && (common > 0 || dialog->ui.text.all)) set_name(dialog, first, common);
}

static bool take_recent(struct dialog *dialog, const struct dialog_recent *recent)
{
    if (recent->missing) {
        snprintf(dialog->error, sizeof dialog->error, "%.300s no longer exists.", recent->path);
        return false;
    }
    ui_text_set(&dialog->ui.text, recent->path);
    dialog_match(dialog);
    return true;
}

/// Puts a match into the path. true for a file; a folder is listed, a missing file reported.
static bool dialog_take(struct dialog *dialog, int match)
{
    const struct dialog_recent *recent = dialog_recent_of(dialog, match);
    if (recent) return take_recent(dialog, recent);
    const char *name = dialog->names[dialog->match[match]];
    size_t length = strlen(name);
    bool folder = length > 0 && name[length - 1] == '/';
    set_name(dialog, name, length);
    return !folder;
}

/// The match that Enter takes without a choice: the only one, if it begins with the text; else −1.
static int dialog_only(const struct dialog *dialog)
{
    const bool single = dialog->kind != DIALOG_SAVE_AS && dialog->match_count == 1 && !dialog_recent_of(dialog, 0);
    return single && begins(dialog, dialog->names[dialog->match[0]]) ? 0 : -1;
}

static bool path_key(struct dialogs *dialogs, struct core *core, int key)
{
    struct dialog *dialog = &dialogs->dialog;
    switch (key) {
    case KEY_ESCAPE:
        dialog_close(dialogs);
        return true;
    case KEY_TAB:
        dialog_complete(dialog);
        return true;
    case KEY_UP:
        move_choice(dialog, -1);
        return true;
    case KEY_DOWN:
        move_choice(dialog, 1);
        return true;
    case KEY_ENTER:
        if (dialog->choice < 0) dialog->choice = dialog_only(dialog);
        if (dialog->choice < 0 || dialog_take(dialog, dialog->choice)) confirm(dialogs, core);
        return true;
    default:
        return false;
    }
}

/// The second press of a double-click on a name.
static bool is_confirmed(const struct dialog *dialog, struct rect list)
{
    const struct ui *ui = &dialog->ui;
    const struct event *event = ui->event;
    bool twice = ui->pass == UI_PASS_EVENT && event->kind == EVENT_BUTTON && event->action == ACTION_PRESS &&
                 event->button == BUTTON_LEFT && event->clicks == 2;
    return twice && rect_contains(list, event->x, event->y) && *path_name(ui->text.bytes);
}

/// A recent file's name, with its folder to the right.
static void label_recent(struct ui *ui, struct rect r, const struct dialog_recent *recent)
{
    char folder[PATH_LIMIT];
    const char *slash = strrchr(recent->path, '/');
    int length = !slash ? 0 : slash > recent->path ? (int)(slash - recent->path) : 1;
    snprintf(folder, sizeof folder, "%.*s", length, recent->path);
    float half = floorf(r.w * 0.45f);
    ui_label(ui, (struct rect){r.x + 6, r.y, half - 6, r.h}, path_name(recent->path),
             recent->missing ? theme()->text_dim : theme()->text);
    ui_label_right(ui, (struct rect){r.x + half + UI_GAP, r.y, r.w - half - UI_GAP - 6, r.h},
                   recent->missing ? "no longer exists" : folder, theme()->text_dim);
}

/// Lays out a match; true if it was pressed.
static bool dialog_row(struct dialog *dialog, struct rect r, int match)
{
    char name[32];
    const struct dialog_recent *recent = dialog_recent_of(dialog, match);
    const char *text = recent ? "" : dialog->names[dialog->match[match]];
    snprintf(name, sizeof name, "dialog.match.%d", match);
    bool pressed = ui_list_row(&dialog->ui, r, name, text, 0, match == dialog->choice);
    if (recent) label_recent(&dialog->ui, r, recent);
    return pressed;
}

static void build_list(struct dialogs *dialogs, struct core *core)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    const int rows = (int)fminf(LIST_ROWS, fmaxf((core->layout.window.h - AROUND_LIST) / UI_ROW, 1));
    struct rect list = {ui->area.x, ui->y, ui->area.w, (float)rows * UI_ROW};
    bool confirmed = is_confirmed(dialog, list);
    int first = dialog->choice >= rows ? dialog->choice - rows + 1 : 0, taken = -1;
    for (int row = 0; row < rows; row++) {
        struct rect r = ui_row(ui, UI_ROW);
        if (first + row < dialog->match_count && dialog_row(dialog, r, first + row)) taken = first + row;
        if (row == 0 && dialog->match_count == 0)
            ui_label(ui, (struct rect){r.x + 6, r.y, r.w - 12, r.h}, "Nothing matches.", theme()->text_dim);
    }
    if (taken >= 0) dialog->error[0] = '\0';
    bool direct = taken >= 0 && dialog_recent_of(dialog, taken); // one click opens a recent file
    bool done = taken >= 0 && !confirmed && dialog_take(dialog, taken);
    if (confirmed || (done && direct)) confirm(dialogs, core);
}

static bool dialog_exists(const struct dialog *dialog)
{
    const char *name = path_name(dialog->ui.text.bytes);
    for (int m = 0; m < dialog->match_count; m++) {
        if (!dialog_recent_of(dialog, m) && strcmp(dialog->names[dialog->match[m]], name) == 0) return true;
    }
    return false;
}

static void build_path(struct dialogs *dialogs, struct core *core)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    bool saving = dialog->kind == DIALOG_SAVE_AS, adding = dialog->kind == DIALOG_ADD;
    const char *title = saving   ? "Save the scene as"
                        : adding ? "Add a character or model (.glb, .gltf)"
                                 : "Open a scene or character";
    ui_label(ui, ui_row(ui, UI_ROW), title, theme()->text);
    ui_space(ui, 4);
    if (ui_text_field(ui, ui_row(ui, 28), "dialog.path")) {
        dialog->error[0] = '\0';
        dialog_match(dialog);
    }
    ui_space(ui, 8);
    if (dialog->files.list) build_list(dialogs, core);
    const char *note = saving && dialog_exists(dialog) ? "This replaces an existing file." : "";
    if (dialog->match_count > 0 && dialog_recent_of(dialog, 0))
        note = "Recent files come first. Type a path or choose one; Tab completes.";
    if (!note[0] && dialog->files.list) note = "Tab completes, arrow keys choose.";
    ui_space(ui, 4);
    float top = ui->y;
    ui_paragraph(ui, dialog->error[0] ? dialog->error : note, dialog->error[0] ? theme()->error : theme()->text_dim);
    ui_space(ui, fmaxf(8, 40 - (ui->y - top)));
    struct rect row = ui_row(ui, 28);
    struct rect right = {row.x + row.w - BUTTON_WIDTH, row.y, BUTTON_WIDTH, row.h};
    struct rect left = {right.x - UI_GAP - BUTTON_WIDTH, row.y, BUTTON_WIDTH, row.h};
    bool cancelled = ui_button(ui, left, "dialog.cancel", "Cancel", false);
    if (ui_button(ui, right, "dialog.confirm", saving ? "Save" : adding ? "Add" : "Open", true))
        confirm(dialogs, core);
    if (cancelled) dialog_close(dialogs);
}

static void build(struct dialogs *dialogs, struct core *core)
{
    struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialog->ui;
    ui_space(ui, 8);
    if (is_question(dialog)) {
        answer(dialogs, core, question_build(dialog));
    } else if (dialog->kind == DIALOG_EXPORT) {
        export_build(dialogs, core);
    } else {
        ui->focus = ui_id(ui, "dialog.path"); // the path is the only text field
        build_path(dialogs, core);
    }
    ui_space(ui, 12);
}

/// Centred, as high as its content.
static struct rect dialog_box(struct dialogs *dialogs, struct core *core)
{
    struct rect window = core->layout.window;
    struct ui *ui = &dialogs->dialog.ui;
    const bool narrow = is_question(&dialogs->dialog) && dialogs->dialog.question.count < 4;
    float w = fminf(narrow ? 440 : 560, window.w - 16);
    ui_begin_find(ui, (struct rect){0, 0, w, window.h}, "", NULL);
    build(dialogs, core);
    float h = fminf(ui->y, window.h - 16);
    ui_end(ui);
    return (struct rect){roundf(window.x + (window.w - w) / 2), roundf(window.y + (window.h - h) / 3), w, h};
}

/// true for every event while a dialog is open, except EVENT_SIZE and EVENT_EXPOSE.
static bool dialog_event(struct dialogs *dialogs, struct core *core, const struct event *event)
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
        bool done = is_question(dialog) ? question_event(dialogs, core, event->key)
                    : exports           ? export_key(dialogs, core, event->key)
                                        : path_key(dialogs, core, event->key);
        if (done) return true;
    }
    if (event->kind == EVENT_WHEEL && !is_question(dialog) && !exports) move_choice(dialog, event->dy > 0 ? -3 : 3);
    struct rect box = dialog_box(dialogs, core);
    ui_begin_event(&dialog->ui, box, event);
    build(dialogs, core);
    ui_end(&dialog->ui);
    return true;
}

static void dialog_show(struct dialogs *dialogs, struct core *core)
{
    struct dialog *dialog = &dialogs->dialog;
    if (dialog->kind == DIALOG_NONE) return;
    struct drawlist *list = &core->list;
    struct rect box = dialog_box(dialogs, core);
    drawlist_rect(list, core->layout.window, theme()->veil);
    drawlist_rounded(list, box, 8, theme()->panel);
    drawlist_rounded_line(list, box, 8, 1, theme()->zero);
    ui_begin_draw(&dialog->ui, box, list);
    build(dialogs, core);
    ui_end(&dialog->ui);
}

struct dialogs *dialogs_create(const struct command *commands, int count)
{
    struct dialogs *dialogs = need_zeroed(1, sizeof *dialogs);
    dialogs->commands = (struct command_list){commands, count};
    return dialogs;
}

void dialogs_destroy(struct dialogs *dialogs) { free(dialogs); }

void dialogs_set_files(struct dialogs *dialogs, const struct dialog_files *files) { dialogs->dialog.files = *files; }

/// In F1's page and the palette a drag scrolls, and a click counts when it ends. false: the event does nothing else.
static bool drag_list(struct dialogs *dialogs, struct event *event)
{
    static const float STEP = 16; // pixels
    struct list_drag *drag = &dialogs->list_drag;
    const bool button = event->kind == EVENT_BUTTON, open = dialogs->help.open || dialogs->palette.open;
    if (button && event->action == ACTION_PRESS && open && !dialogs_are_asking(dialogs)) {
        *drag = (struct list_drag){.held = true, .y = event->y};
        return false;
    }
    if (!drag->held || !open || (!button && event->kind != EVENT_POINTER)) return true;
    drag->held = !button;
    event->action = ACTION_PRESS;
    if (button) return !drag->moved;
    const float steps = truncf((event->y - drag->y) / STEP);
    drag->y += steps * STEP;
    drag->moved |= steps != 0;
    event->kind = EVENT_WHEEL;
    event->dy = steps / 3;
    return steps != 0;
}

bool dialogs_event(struct dialogs *dialogs, struct core *core, const struct event *event)
{
    struct event meant = *event;
    if (!drag_list(dialogs, &meant)) return true;
    const bool calm = meant.kind == EVENT_POINTER && dialogs->dialog.kind == DIALOG_NONE;
    return !calm && (dialog_event(dialogs, core, &meant) || palette_event(dialogs, core, &meant) ||
                     help_event(dialogs, core, &meant) || welcome_event(dialogs, &meant));
}

void dialogs_show(struct dialogs *dialogs, struct core *core)
{
    help_show(dialogs, core);
    palette_show(dialogs, core);
    dialog_show(dialogs, core);
}

bool dialogs_are_asking(const struct dialogs *dialogs) { return dialogs->dialog.kind != DIALOG_NONE; }

bool dialogs_cover(const struct dialogs *dialogs)
{
    return dialogs_are_asking(dialogs) || dialogs->help.open || dialogs->palette.open;
}

bool dialogs_over(const struct dialogs *dialogs, enum ui_over *over)
{
    *over = dialogs->dialog.kind != DIALOG_NONE ? dialogs->dialog.ui.over : UI_OVER_NOTHING;
    return dialogs_cover(dialogs);
}

float dialogs_bottom(const struct dialogs *dialogs, const struct core *core)
{
    const struct rect *stage = &core->layout.stage;
    return dialogs->welcome ? dialogs->card.y : stage->y + stage->h;
}
