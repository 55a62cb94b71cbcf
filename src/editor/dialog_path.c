/// Completion of the path in the file dialogs.
#include "editor/dialog.h"
#include <stdio.h>
#include <string.h>

/// The part of the path behind the last '/'.
static const char *name_part(const struct dialog *dialog)
{
    const char *path = dialog->ui.text.bytes;
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
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

void dialog_match(struct dialog *dialog)
{
    char folder[UI_TEXT_SIZE];
    const char *name = name_part(dialog);
    snprintf(folder, sizeof folder, "%.*s", (int)(name - dialog->ui.text.bytes), dialog->ui.text.bytes);
    list_folder(dialog, folder);
    dialog->match_count = 0;
    dialog->choice = -1;
    size_t length = strlen(name);
    for (int i = 0; i < dialog->name_count; i++) {
        // While the whole name is selected, the next character replaces it: everything is still open.
        bool fits = dialog->ui.text.all || strncmp(dialog->names[i], name, length) == 0;
        if (fits) dialog->match[dialog->match_count++] = i;
    }
}

static void set_name(struct dialog *dialog, const char *name, size_t length)
{
    char path[UI_TEXT_SIZE];
    int folder = (int)(name_part(dialog) - dialog->ui.text.bytes);
    snprintf(path, sizeof path, "%.*s%.*s", folder, dialog->ui.text.bytes, (int)length, name);
    ui_text_set(&dialog->ui.text, path);
    dialog_match(dialog);
}

void dialog_complete(struct dialog *dialog)
{
    if (dialog->match_count == 0) return;
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

bool dialog_take(struct dialog *dialog, int match)
{
    const char *name = dialog->names[dialog->match[match]];
    size_t length = strlen(name);
    bool folder = length > 0 && name[length - 1] == '/';
    set_name(dialog, name, length);
    return !folder;
}

bool dialog_exists(const struct dialog *dialog)
{
    const char *name = name_part(dialog);
    for (int m = 0; m < dialog->match_count; m++) {
        if (strcmp(dialog->names[dialog->match[m]], name) == 0) return true;
    }
    return false;
}
