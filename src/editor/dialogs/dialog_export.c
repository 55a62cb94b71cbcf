/// The Export dialog: a file name whose extension is the format, the frames, and the format's options.
#include "base/file.h"
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/dialogs/state.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { STEM_MORE = 32 }; ///< bytes that an extension may add
enum { LEAST_ROWS = 3, CHOICE_ROWS = 3, NUMBER_WIDTH = 72, ENDING_WIDTH = 56, NOTE_HEIGHT = 40, MAX_SIDE = 8192 };

static const char path_field[] = "export.path", clip_field[] = "export.clip";

/// Height of everything but lists and buttons.
static const float FRAME_HEIGHT = 300;

static bool is_running(const struct dialog *dialog) { return dialog->awaited == REQUEST_EXPORT; }

/// The format of a path's extension, or -1.
static int format_by_ending(const struct dialog_files *files, const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int f = 0; dot && f < files->format_count; f++) {
        if (strcasecmp(dot, files->formats[f].ending) == 0) return f;
    }
    return -1;
}

static const struct dialog_format *format_of(const struct dialogs *dialogs)
{
    return &dialogs->dialog.files.formats[dialogs->exporting.format];
}

/// Replaces a path's extension by a format's; false if the path gets too long.
static bool with_ending(const struct dialog_files *files, const char *path, int format, char full[PATH_LIMIT])
{
    const size_t length = strlen(path);
    const int old = format_by_ending(files, path);
    const size_t stem = old >= 0 ? length - strlen(files->formats[old].ending) : length;
    return snprintf(full, PATH_LIMIT, "%.*s%s", (int)stem, path, files->formats[format].ending) < PATH_LIMIT;
}

static void choose_format(struct dialogs *dialogs, int format)
{
    struct exporting *exporting = &dialogs->exporting;
    char full[PATH_LIMIT];
    if (with_ending(&dialogs->dialog.files, exporting->memory.path, format, full))
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

/// Names the file after the scene, or else after the character, but never like that character's own file.
static void name_export(char path[PATH_LIMIT], const struct core *core)
{
    const struct document *document = core->document;
    char scene[PATH_LIMIT], own[PATH_LIMIT];
    const int model = document_find_rig(document, RIG_MODEL, 0);
    const bool has_model = model >= 0 && stem_of(document->folder, document->rigs[model]->model.model, own);
    const char *like = core->path[0] ? core->path : has_model ? own : "untitled";
    snprintf(path, PATH_LIMIT, "%.*s", PATH_LIMIT - STEM_MORE, like);
    if (path_has_end(path, ".json")) path[strlen(path) - strlen(".json")] = '\0';
    if (has_model && (like == own || (stem_of(NULL, core->path, scene) && strcmp(scene, own) == 0)))
        strcat(path, "-animated");
}

/// For another scene: keeps the last format.
static void begin_memory(struct dialogs *dialogs, const struct core *core)
{
    struct export_memory *memory = &dialogs->exporting.memory;
    snprintf(memory->scene, sizeof memory->scene, "%s", core->path);
    name_export(memory->path, core);
    choose_format(dialogs, dialogs->exporting.format);
    memory->wish.part = false;
    memory->wish.clip[0] = '\0';
    memory->wish.rig = 0;
}

void dialogs_export(struct dialogs *dialogs, const struct core *core)
{
    struct exporting *exporting = &dialogs->exporting;
    struct export_memory *memory = &exporting->memory;
    const struct dialog_files *files = &dialogs->dialog.files;
    if (files->format_count == 0) return;
    const int last = format_by_ending(files, memory->path);
    if (last >= 0) exporting->format = last;
    const bool same = core->path[0] ? strcmp(memory->scene, core->path) == 0 : exporting->serial == core->serial;
    if (!same || !memory->path[0]) begin_memory(dialogs, core);
    exporting->serial = core->serial;
    exporting->typed = 0;
    exporting->done = exporting->total = 0;
    struct export_wish *wish = &memory->wish;
    const struct document *document = core->document;
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

void dialogs_tell_export(struct dialogs *dialogs, long done, long total)
{
    dialogs->exporting.done = done;
    dialogs->exporting.total = total;
}

static void confirm(struct dialogs *dialogs, struct core *core)
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
    if (!with_ending(&dialog->files, memory->path, dialogs->exporting.format, full)) {
        snprintf(dialog->error, sizeof dialog->error, "The path is too long.");
        return;
    }
    dialogs->exporting.done = dialogs->exporting.total = 0;
    dialog_await(dialogs, core, REQUEST_EXPORT, full);
    core->request.wish = memory->wish;
}

static void stop(struct dialogs *dialogs, struct core *core)
{
    if (is_running(&dialogs->dialog)) {
        core_request(core, REQUEST_EXPORT_STOP, NULL);
    } else {
        dialog_close(dialogs);
    }
}

bool export_key(struct dialogs *dialogs, struct core *core, int key)
{
    const struct ui *ui = &dialogs->dialog.ui;
    const bool in_text = ui->focus == ui_id(ui, path_field) || ui->focus == ui_id(ui, clip_field);
    const int format = dialogs->exporting.format, last = dialogs->dialog.files.format_count - 1;
    if (key == KEY_ESCAPE && !ui->typing && !ui->held) {
        stop(dialogs, core);
    } else if (is_running(&dialogs->dialog)) {
        return key != KEY_ENTER && key != KEY_SPACE; // Enter and Space press the button
    } else if (key == KEY_ENTER && in_text) {
        confirm(dialogs, core);
    } else if (key == KEY_UP && in_text) {
        choose_format(dialogs, format > 0 ? format - 1 : 0);
    } else if (key == KEY_DOWN && in_text) {
        choose_format(dialogs, format < last ? format + 1 : last);
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

static void build_path(struct dialogs *dialogs)
{
    struct exporting *exporting = &dialogs->exporting;
    char *path = exporting->memory.path;
    if (!build_text(dialogs, ui_row(&dialogs->dialog.ui, 28), path_field, path, PATH_LIMIT)) return;
    const int format = format_by_ending(&dialogs->dialog.files, path);
    if (format >= 0) exporting->format = format;
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

static void build_frames(struct dialogs *dialogs, const struct document *document, struct rect *row)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    const double first = document->first_frame, last = document->last_frame;
    struct rect r = labelled(&dialogs->dialog.ui, row, PAIR_WIDTH, "frames");
    r.w = NUMBER_WIDTH;
    bool changed = build_number(
        dialogs, r, (struct ui_number){.name = "export.first", .lowest = first, .highest = wish->last}, &wish->first);
    changed |=
        build_number(dialogs, second(&dialogs->dialog.ui, r, "to"),
                     (struct ui_number){.name = "export.last", .lowest = wish->first, .highest = last}, &wish->last);
    if (changed) wish->part = wish->first > first || wish->last < last;
}

static void build_size(struct dialogs *dialogs, const struct dialog_format *format, struct rect *row)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    struct rect r = labelled(&dialogs->dialog.ui, row, PAIR_WIDTH, "size");
    double width = wish->width > 0 ? wish->width : format->width;
    double height = wish->height > 0 ? wish->height : format->height;
    r.w = NUMBER_WIDTH;
    bool changed = build_number(
        dialogs, r, (struct ui_number){.name = "export.width", .lowest = 16, .highest = MAX_SIDE}, &width);
    changed |= build_number(dialogs, second(&dialogs->dialog.ui, r, "×"),
                            (struct ui_number){.name = "export.height", .lowest = 16, .highest = MAX_SIDE}, &height);
    if (!changed) return;
    wish->width = (int)width;
    wish->height = (int)height;
}

static void build_keys(struct dialogs *dialogs, const struct document *document, struct rect *row)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    double keys = wish->keys > 0 ? wish->keys : document->substeps;
    const struct rect r = labelled(&dialogs->dialog.ui, row, NUMBER_WIDTH, "keys a frame");
    if (build_number(dialogs, r,
                     (struct ui_number){.name = "export.keys", .lowest = 1, .highest = SCENE_MAX_SUBSTEPS}, &keys))
        wish->keys = (int)keys;
}

static bool is_offered(const struct rig *rig, unsigned choices)
{
    if (choices & CHOICE_JOINTS) return rig->kind == RIG_TAIL || rig->kind == RIG_MODEL;
    return rig->kind != RIG_CHAIN; // exported with its character
}

static const char *label_of(const struct rig *rig) { return rig->name ? rig->name : rig_word(rig->kind); }

/// The next rig to export; 0 for all after the last, where the format allows that.
static void next_rig(struct export_wish *wish, const struct document *document, unsigned choices)
{
    int current = -1, first = -1, next = -1;
    for (int i = 0; i < document->rig_count; i++) {
        const struct rig *rig = document->rigs[i];
        if (!is_offered(rig, choices)) continue;
        if (first < 0) first = i;
        if (current >= 0 && next < 0) next = i;
        if (rig->id == wish->rig) current = i;
    }
    if (next < 0 && (current < 0 || (choices & CHOICE_ONE))) next = first;
    wish->rig = next >= 0 ? document->rigs[next]->id : 0;
}

/// The label of the rig that is chosen, or NULL; and how many are offered.
static const char *chosen_rig(const struct document *document, const struct export_wish *wish, unsigned choices,
                              int *offered)
{
    const char *label = NULL;
    *offered = 0;
    for (int i = 0; i < document->rig_count; i++) {
        if (!is_offered(document->rigs[i], choices)) continue;
        if (document->rigs[i]->id == wish->rig) label = label_of(document->rigs[i]);
        (*offered)++;
    }
    return label;
}

static void build_rig(struct dialogs *dialogs, const struct document *document, unsigned choices, struct rect *row)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    int offered = 0;
    const char *label = chosen_rig(document, wish, choices, &offered);
    if (!label) wish->rig = 0; // the rig belonged to another format or is gone
    if (offered < 2) return;
    if ((choices & CHOICE_ONE) && !label) {
        next_rig(wish, document, choices);
        label = chosen_rig(document, wish, choices, &offered);
    }
    const struct rect r = labelled(&dialogs->dialog.ui, row, NUMBER_WIDTH + 48, "rig");
    if (ui_button(&dialogs->dialog.ui, r, "export.rig", label ? label : "all rigs", false))
        next_rig(wish, document, choices);
}

static void build_toggle(struct ui *ui, struct rect *row, const char *name, const char *label, bool *on)
{
    enum { TOGGLE = 28, WORDS = 140 };
    ui_toggle(ui, *row, name, on);
    ui_label(ui, (struct rect){row->x + TOGGLE + UI_GAP, row->y, WORDS, row->h}, label, theme()->text_dim);
    row->x += TOGGLE + WORDS + 2 * UI_GAP;
}

static void build_flags(struct dialogs *dialogs, const struct document *document, unsigned choices, struct rect row)
{
    struct export_wish *wish = &dialogs->exporting.memory.wish;
    struct ui *ui = &dialogs->dialog.ui;
    const bool morphs = document_find_rig(document, RIG_CHARACTER, 0) >= 0;
    if (choices & CHOICE_CUBIC) build_toggle(ui, &row, "export.cubic", "keys with tangents", &wish->is_cubic);
    if ((choices & CHOICE_CUBIC) && document_find_rig(document, RIG_CHAIN, 0) >= 0)
        build_toggle(ui, &row, "export.clips", "all clips", &wish->all_clips);
    if ((choices & CHOICE_SIGNED) && morphs)
        build_toggle(ui, &row, "export.signed", "signed morph targets", &wish->is_signed);
    if (choices & CHOICE_ALPHA) build_toggle(ui, &row, "export.transparent", "transparent", &wish->transparent);
}

/// The default clip name: for an imported character, its current clip's.
static const char *usual_clip(const struct document *document)
{
    const int rig = document_next_rig(document, RIG_MODEL, -1);
    return rig >= 0 && document->rigs[rig]->model.clip ? document->rigs[rig]->model.clip : "as the scene";
}

/// Has the same number of rows for every format, so that nothing jumps.
static void build_choices(struct dialogs *dialogs, const struct document *document)
{
    struct export_memory *memory = &dialogs->exporting.memory;
    struct ui *ui = &dialogs->dialog.ui;
    const struct dialog_format *format = format_of(dialogs);
    const bool narrow = ui->area.w < 480; // one choice a row
    struct rect rows[CHOICE_ROWS + 2];
    for (int i = 0; i < CHOICE_ROWS + 2 * narrow; i++) rows[i] = ui_row(ui, UI_ROW);
    build_frames(dialogs, document, &rows[0]);
    if (format->choices & CHOICE_KEYS) build_keys(dialogs, document, &rows[narrow ? CHOICE_ROWS : 0]);
    if (format->choices & CHOICE_SIZE) build_size(dialogs, format, &rows[1]);
    if (format->choices & CHOICE_CLIP) {
        const struct rect r = labelled(ui, &rows[1], PAIR_WIDTH, "clip");
        build_text(dialogs, (struct rect){r.x, r.y + 2, r.w, r.h - 4}, clip_field, memory->wish.clip,
                   sizeof memory->wish.clip);
        if (!memory->wish.clip[0] && ui->focus != ui_id(ui, clip_field))
            ui_label(ui, (struct rect){r.x + 8, r.y, r.w - 16, r.h}, usual_clip(document), theme()->text_dim);
    }
    if (format->choices & CHOICE_RIG)
        build_rig(dialogs, document, format->choices, &rows[narrow ? CHOICE_ROWS + 1 : 1]);
    build_flags(dialogs, document, format->choices, rows[2]);
}

static void build_formats(struct dialogs *dialogs, float room)
{
    const struct dialog_files *files = &dialogs->dialog.files;
    struct exporting *exporting = &dialogs->exporting;
    struct ui *ui = &dialogs->dialog.ui;
    const int chosen = exporting->format, fitting = (int)(room / UI_ROW);
    const int rows = fitting < LEAST_ROWS            ? LEAST_ROWS
                     : fitting > files->format_count ? files->format_count
                                                     : fitting;
    const struct rect view = {ui->area.x, ui->y, ui->area.w, (float)rows * UI_ROW};
    // Scroll to the format being typed.
    if (ui->focus == ui_id(ui, path_field))
        exporting->scroll.offset =
            fmaxf(fminf(exporting->scroll.offset, (float)chosen * UI_ROW), (float)(chosen + 1 - rows) * UI_ROW);
    int taken = -1;
    ui_scroll_begin(ui, &exporting->scroll, view);
    for (int f = 0; f < files->format_count; f++) {
        char name[32];
        const struct rect r = ui_row(ui, UI_ROW);
        snprintf(name, sizeof name, "export%s", files->formats[f].ending);
        if (ui_list_row(ui, r, name, "", 0, f == chosen)) taken = f;
        ui_label(ui, (struct rect){r.x + 6, r.y, ENDING_WIDTH, r.h}, files->formats[f].ending, theme()->text);
        ui_label(ui, (struct rect){r.x + 6 + ENDING_WIDTH, r.y, r.w - 12 - ENDING_WIDTH, r.h},
                 files->formats[f].holds, theme()->text_dim);
    }
    ui_scroll_end(ui);
    if (taken >= 0) choose_format(dialogs, taken);
}

static void build_note(struct dialogs *dialogs, const struct document *document)
{
    const struct dialog *dialog = &dialogs->dialog;
    const struct exporting *exporting = &dialogs->exporting;
    const struct export_wish *wish = &exporting->memory.wish;
    const struct dialog_format *format = format_of(dialogs);
    struct ui *ui = &dialogs->dialog.ui;
    const float top = ui->y;
    char text[160];
    if (is_running(dialog) && exporting->total > 0) {
        snprintf(text, sizeof text, "%ld of %ld. Esc cancels and leaves nothing behind.", exporting->done,
                 exporting->total);
    } else if (is_running(dialog)) {
        snprintf(text, sizeof text, "Getting ready. Esc cancels and leaves nothing behind.");
    } else {
        const int keys = wish->keys > 0 ? wish->keys : document->substeps;
        double rate = document->fps * keys, count = (wish->last - wish->first) * keys + 1;
        if (format->pictures) count = format->pictures(format->ending, document, wish->first, wish->last, &rate);
        snprintf(text, sizeof text, "%.0f %s%s, %g a second. ↑ ↓ choose the format, Tab goes to the choices.", count,
                 format->pictures ? "picture" : "key", count == 1 ? "" : "s", rate);
    }
    if (is_running(dialog)) {
        const struct rect bar = ui_row(ui, 8);
        const float part = exporting->total > 0 ? (float)exporting->done / (float)exporting->total : 0;
        if (ui->pass == UI_PASS_DRAW) {
            drawlist_rounded(ui->list, bar, 4, theme()->fill);
            drawlist_rounded(ui->list, (struct rect){bar.x, bar.y, fmaxf(8, bar.w * part), bar.h}, 4,
                             theme()->accent);
        }
        ui_space(ui, 4);
    }
    ui_paragraph(ui,
                 dialog->error[0]   ? dialog->error
                 : ui->complaint[0] ? ui->complaint
                                    : text,
                 dialog->error[0] || ui->complaint[0] ? theme()->error : theme()->text_dim);
    ui_space(ui, fmaxf(8, NOTE_HEIGHT - (ui->y - top)));
}

static void build_buttons(struct dialogs *dialogs, struct core *core)
{
    enum { CANCEL_WIDTH = 104, WRITE_WIDTH = 240 };
    const struct dialog *dialog = &dialogs->dialog;
    struct ui *ui = &dialogs->dialog.ui;
    char label[64], full[PATH_LIMIT] = "";
    const struct rect row = ui_row(ui, 28);
    const float width = fminf(WRITE_WIDTH, row.w - CANCEL_WIDTH - UI_GAP);
    const struct rect right = {row.x + row.w - width, row.y, width, row.h};
    const float end = is_running(dialog) ? row.x + row.w : right.x - UI_GAP;
    const struct rect left = {end - CANCEL_WIDTH, row.y, CANCEL_WIDTH, row.h};
    with_ending(&dialog->files, dialogs->exporting.memory.path, dialogs->exporting.format, full);
    snprintf(label, sizeof label, "Write %.48s", path_name(full));
    const bool stopped = ui_button(ui, left, "dialog.cancel", "Cancel", false);
    if (!is_running(dialog) && ui_button(ui, right, "dialog.confirm", label, true)) confirm(dialogs, core);
    if (stopped) stop(dialogs, core);
}

void export_build(struct dialogs *dialogs, struct core *core)
{
    struct export_memory *memory = &dialogs->exporting.memory;
    struct ui *ui = &dialogs->dialog.ui;
    if (is_running(&dialogs->dialog)) {
        char title[96];
        snprintf(title, sizeof title, "Writing %.80s", path_name(memory->path));
        ui_label(ui, ui_row(ui, UI_ROW), title, theme()->text);
        ui_space(ui, 4);
    } else {
        ui_label(ui, ui_row(ui, UI_ROW), "Export the motion", theme()->text);
        ui_space(ui, 4);
        build_path(dialogs);
        ui_space(ui, 8);
        build_formats(dialogs, core->layout.window.h - FRAME_HEIGHT);
        ui_space(ui, 8);
        build_choices(dialogs, core->document);
        ui_space(ui, 4);
    }
    build_note(dialogs, core->document);
    build_buttons(dialogs, core);
}
