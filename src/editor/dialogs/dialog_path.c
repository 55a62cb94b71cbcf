/// Completion of the path in the file dialogs, and the list of what it may become.
#include "base/path.h"
#include "editor/dialogs/dialog.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static void list_folder(struct dialog *dialog, const char *folder)
{
    if (dialog->name_count >= 0 && strcmp(folder, dialog->listed) == 0) return;
    snprintf(dialog->listed, sizeof dialog->listed, "%s", folder);
    dialog->name_count = 0;
    if (!dialog->files.list) return;
    int count = dialog->files.list(dialog->files.user, *folder ? folder : ".", dialog->names, DIALOG_MAX_NAMES);
    dialog->name_count = count > 0 ? count : 0;
}

static bool is_scene(const char *name)
{
    const size_t length = strlen(name);
    return length >= 5 && strcmp(name + length - 5, ".json") == 0;
}

void dialog_match(struct dialog *dialog)
{
    char folder[UI_TEXT_SIZE];
    const char *name = path_name(dialog->ui.text.bytes);
    snprintf(folder, sizeof folder, "%.*s", (int)(name - dialog->ui.text.bytes), dialog->ui.text.bytes);
    list_folder(dialog, folder);
    dialog->match_count = 0;
    dialog->choice = -1;
    bool empty = dialog->kind == DIALOG_OPEN && !dialog->ui.text.bytes[0];
    for (int i = 0; empty && i < dialog->recent_count; i++)
        dialog->match[dialog->match_count++] = DIALOG_MAX_NAMES + i;
    size_t length = strlen(name);
    for (int i = 0; i < dialog->name_count; i++) {
        // While the whole name is selected, the next character replaces it: everything is still open.
        bool fits = dialog->ui.text.all || strncmp(dialog->names[i], name, length) == 0;
        if (dialog->kind == DIALOG_ADD && is_scene(dialog->names[i])) fits = false;
        if (fits) dialog->match[dialog->match_count++] = i;
    }
}

static void set_name(struct dialog *dialog, const char *name, size_t length)
{
    char path[UI_TEXT_SIZE];
    int folder = (int)(path_name(dialog->ui.text.bytes) - dialog->ui.text.bytes);
    snprintf(path, sizeof path, "%.*s%.*s", folder, dialog->ui.text.bytes, (int)length, name);
    ui_text_set(&dialog->ui.text, path);
    dialog_match(dialog);
}

void dialog_complete(struct dialog *dialog)
{
    if (dialog->match_count == 0 || dialog_recent_of(dialog, 0)) return;
    const char *first = dialog->names[dialog->match[0]];
    size_t common = strlen(first);
    for (int m = 1; m < dialog->match_count; m++) {
        const char *other = dialog->names[dialog->match[m]];
        size_t same = 0;
        while (same < common && other[same] == first[same]) same++;
        common = same;
    }
    while (common > 0 && ((unsigned char)first[common] & 0xC0) == 0x80) common--; // never half a character
    if (common > 0 || dialog->ui.text.all) set_name(dialog, first, common);
}

const struct dialog_recent *dialog_recent_of(const struct dialog *dialog, int match)
{
    int recent = dialog->match[match] - DIALOG_MAX_NAMES;
    return recent >= 0 ? &dialog->recent[recent] : NULL;
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

bool dialog_take(struct dialog *dialog, int match)
{
    const struct dialog_recent *recent = dialog_recent_of(dialog, match);
    if (recent) return take_recent(dialog, recent);
    const char *name = dialog->names[dialog->match[match]];
    size_t length = strlen(name);
    bool folder = length > 0 && name[length - 1] == '/';
    set_name(dialog, name, length);
    return !folder;
}

bool dialog_exists(const struct dialog *dialog)
{
    const char *name = path_name(dialog->ui.text.bytes);
    for (int m = 0; m < dialog->match_count; m++) {
        if (!dialog_recent_of(dialog, m) && strcmp(dialog->names[dialog->match[m]], name) == 0) return true;
    }
    return false;
}

/// A recent file: its name, and right of it the folder that it is in.
static void label_recent(struct ui *ui, struct rect r, const struct dialog_recent *recent)
{
    char folder[PATH_LIMIT];
    const char *slash = strrchr(recent->path, '/');
    int length = slash && slash > recent->path ? (int)(slash - recent->path) : 1;
    snprintf(folder, sizeof folder, "%.*s", length, recent->path);
    float half = floorf(r.w * 0.45f);
    ui_label(ui, (struct rect){r.x + 6, r.y, half - 6, r.h}, path_name(recent->path),
             recent->missing ? theme()->text_dim : theme()->text);
    ui_label_right(ui, (struct rect){r.x + half + UI_GAP, r.y, r.w - half - UI_GAP - 6, r.h},
                   recent->missing ? "no longer exists" : folder, theme()->text_dim);
}

bool dialog_row(struct dialog *dialog, struct rect r, int match)
{
    char name[32];
    const struct dialog_recent *recent = dialog_recent_of(dialog, match);
    const char *text = recent ? "" : dialog->names[dialog->match[match]];
    snprintf(name, sizeof name, "dialog.match.%d", match);
    bool pressed = ui_list_row(&dialog->ui, r, name, text, 0, match == dialog->choice);
    if (recent) label_recent(&dialog->ui, r, recent);
    return pressed;
}
