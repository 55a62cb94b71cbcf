/// Saves a document in one step: paint that has changed goes to files of new names beside the scene, then the scene that names them takes
/// the old one's place, then what only the old one named is removed. Whenever that ends, the scene on disk is the old one with
/// the old paint, or the new one with the new.
#include "base/file.h"
#include "base/hash.h"
#include "base/need.h"
#include "scene/leftovers.h"
#include "scene/load.h"
#include "scene/paint_file.h"
#include "scene/text.h"
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_NAMES = 10000, SHEET_LINE = 128 };

/// A character's paint while it is saved.
struct sheet {
    bool written;
    char *old_path; ///< the rig's, restored on failure; owned once written
    char file[PATH_LIMIT];
    char replaced[PATH_LIMIT]; ///< the file that it stands for from now on, or ""
};

/// The first name that is free: an existing file may belong to another scene.
static bool new_file(const char *scene, char file[PATH_LIMIT])
{
    for (int i = 1; i < MAX_NAMES && leftovers_name(scene, i, file); i++) {
        if (access(file, F_OK) != 0) return true;
    }
    return false;
}

/// Whether an earlier rig has its paint in the same file.
static bool is_shared(const struct document *document, int index)
{
    const char *path = document->rigs[index]->character.file->path;
    int i = document_next_rig(document, RIG_CHARACTER, 0);
    for (; i < index; i = document_next_rig(document, RIG_CHARACTER, i + 1)) {
        const struct character_rig *other = &document->rigs[i]->character;
        if (other->file->path && other->painted && strcmp(other->file->path, path) == 0) return true;
    }
    return false;
}

/// Whether a rig's paint is in a file of its own, which the scene keeps; `own` is its path then.
static bool has_own_file(const struct document *document, int index, const char *scene, char own[PATH_LIMIT])
{
    const struct character_rig *rig = &document->rigs[index]->character;
    const bool stays = document->path && strcmp(document->path, scene) == 0;
    return stays && rig->file->path && rig->file->version != 0 && !is_shared(document, index) &&
           path_resolve(document->folder, rig->file->path, own) && access(own, F_OK) == 0;
}

/// Makes the rig name the new file, relative to the document's folder.
static bool name_file(struct document *document, struct character_rig *rig, struct sheet *sheet, struct error *error)
{
    char folder[PATH_LIMIT], moved[PATH_LIMIT];
    const char *name = path_name(sheet->file);
    if (!path_folder(sheet->file, folder)) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", name);
    sheet->old_path = rig->file->path;
    rig->file->path = need_text(path_rebase(name, folder, document->folder, moved) ? moved : name);
    return true;
}

static bool save_sheet(struct document *document, int index, struct leftovers *leftovers, struct sheet *sheet,
                       struct error *error)
{
    const char *scene = leftovers->scene;
    struct character_rig *rig = &document->rigs[index]->character;
    if (document->rigs[index]->kind != RIG_CHARACTER) return true;
    if (!rig->painted || paint_is_plain(rig->painted)) return true;
    if (has_own_file(document, index, scene, sheet->replaced)) {
        if (rig->file->version == rig->painted->version && !file_stamp_differs(sheet->replaced, &rig->file->stamp))
            return true;
    } else {
        sheet->replaced[0] = '\0';
    }
    if (!new_file(scene, sheet->file))
        return fail(error, ERROR_ENVIRONMENT, "%s: there is no name left for its paint", scene);
    leftovers_note(leftovers, sheet->file);
    if (sheet->replaced[0]) leftovers_note(leftovers, sheet->replaced);
    if (!paint_write(rig->painted, sheet->file, sheet->replaced, error)) return false;
    if (!name_file(document, rig, sheet, error)) {
        unlink(sheet->file);
        return false;
    }
    sheet->written = true;
    return true;
}

/// Keeps the new names and files, or undoes both on failure.
static void finish(struct document *document, struct sheet *sheets, int count, bool saved)
{
    for (int i = 0; i < count; i++) {
        struct character_rig *rig = &document->rigs[i]->character;
        struct sheet *sheet = &sheets[i];
        if (!sheet->written) continue;
        if (saved) {
            rig->file->version = rig->painted->version;
            rig->file->stamp = file_stamp(sheet->file);
            free(sheet->old_path);
            if (sheet->replaced[0]) leftovers_remove(sheet->replaced);
        } else {
            unlink(sheet->file);
            free(rig->file->path);
            rig->file->path = sheet->old_path;
        }
    }
}

static bool save_scene(const struct document *document, const char *path, struct error *error)
{
    char folder[PATH_LIMIT], *data = NULL;
    size_t capacity = 0, size;
    if (!path_folder(path, folder)) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", path);
    scene_print_into(document, folder, &data, &capacity, &size);
    const bool saved = file_write_atomic(path, data, size, error);
    free(data);
    return saved;
}

bool scene_save(struct document *document, const char *path, struct error *error)
{
    const int count = document->rig_count;
    struct sheet *sheets = need_zeroed((size_t)count, sizeof *sheets);
    struct leftovers leftovers;
    leftovers_open(&leftovers, path);
    bool saved = true;
    for (int i = 0; saved && i < count; i++) saved = save_sheet(document, i, &leftovers, &sheets[i], error);
    saved = saved && save_scene(document, path, error);
    finish(document, sheets, count, saved);
    leftovers_close(&leftovers);
    free(sheets);
    return saved;
}

bool scene_read_paint(struct document *document, struct error *error)
{
    struct error first = {0};
    int i = document_next_rig(document, RIG_CHARACTER, 0);
    for (; i >= 0; i = document_next_rig(document, RIG_CHARACTER, i + 1)) {
        const struct character_rig *character = &document->rigs[i]->character;
        if (!character->file->path || character->painted || character->file->version != 0) continue;
        struct character_rig *rig = &document_own_rig(document, i)->character;
        struct error trouble = {0};
        char path[PATH_LIMIT];
        if (path_resolve(document->folder, rig->file->path, path)) {
            rig->file->stamp = file_stamp(path);
            rig->painted = paint_read(path, &trouble);
        } else {
            fail(&trouble, ERROR_INPUT, "%s: the path is too long", rig->file->path);
        }
        if (rig->painted) rig->file->version = rig->painted->version;
        if (first.kind == ERROR_NONE) first = trouble;
    }
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

/// Whether another program has written the file that a rig's paint was read from or written to; `path` is its path then.
static bool is_theirs(const struct document *document, struct rig *rig, char path[PATH_LIMIT])
{
    const struct character_rig *character = &rig->character;
    struct paint_file *file = character->file;
    return file->path && file->stamp.is_there && path_resolve(document->folder, file->path, path) &&
           file_stamp_differs(path, &file->stamp);
}

uint64_t scene_paint_theirs(struct document *document, const char **name)
{
    uint64_t hash = 0;
    int i = document_next_rig(document, RIG_CHARACTER, 0);
    for (; i >= 0; i = document_next_rig(document, RIG_CHARACTER, i + 1)) {
        char path[PATH_LIMIT];
        if (!is_theirs(document, document->rigs[i], path)) continue;
        const uint64_t content = file_stamp(path).content;
        if (hash == 0) *name = document->rigs[i]->character.file->path;
        hash = hash_bytes(hash ? hash : HASH_START, &content, sizeof content);
    }
    return hash;
}

void scene_keep_paint(struct document *document)
{
    int i = document_next_rig(document, RIG_CHARACTER, 0);
    for (; i >= 0; i = document_next_rig(document, RIG_CHARACTER, i + 1)) {
        struct character_rig *rig = &document->rigs[i]->character;
        char path[PATH_LIMIT];
        if (!is_theirs(document, document->rigs[i], path)) continue;
        rig->file->version = UINT64_MAX;
        rig->file->stamp = file_stamp(path);
    }
}

/// Number, size, whether there is a file, and what that held.
static void print_sheet_line(struct text *text, int character, const struct character_rig *rig)
{
    char line[SHEET_LINE];
    const struct file_stamp *file = &rig->file->stamp;
    const bool has_file = rig->file->version != 0;
    int length = snprintf(line, sizeof line, "paint %d %zu %d", character, paint_file_size(rig->painted), has_file);
    if (has_file && file->is_there)
        length += snprintf(line + length, sizeof line - (size_t)length, " %lld %llx", (long long)file->size,
                           (unsigned long long)file->content);
    text_string(text, line);
    text_string(text, "\n");
}

/// The character that the line is of, or NULL. `bytes` of paint follow; its file may hold older paint, or another program's.
static struct character_rig *parse_sheet_line(struct document *document, const char *text, size_t length,
                                              size_t *bytes)
{
    char line[SHEET_LINE];
    int character, has_file;
    long long size;
    unsigned long long content;
    if (length >= sizeof line) return NULL;
    memcpy(line, text, length);
    line[length] = '\0';
    const int read = sscanf(line, "paint %d %zu %d %lld %llx", &character, bytes, &has_file, &size, &content);
    struct character_rig *rig = read == 3 || read == 5 ? document_character(document, character) : NULL;
    if (!rig) return NULL;
    rig->file->version = has_file && rig->file->path ? UINT64_MAX : 0;
    if (read == 5) rig->file->stamp = (struct file_stamp){.is_there = true, .size = size, .content = content};
    return rig;
}

void scene_print_paint(const struct document *document, char **buffer, size_t *capacity, size_t *size)
{
    struct text text = {.data = *buffer, .size = *size, .capacity = *capacity};
    int i = document_next_rig(document, RIG_CHARACTER, 0);
    for (int character = 0; i >= 0; i = document_next_rig(document, RIG_CHARACTER, i + 1), character++) {
        const struct character_rig *rig = &document->rigs[i]->character;
        if (!rig->painted) continue;
        if (text.size == *size) text_bytes(&text, "", 1);
        print_sheet_line(&text, character, rig);
        paint_print(&text, rig->painted);
    }
    *buffer = text.data;
    *capacity = text.capacity;
    *size = text.size;
}

bool scene_parse_paint(struct document *document, const char *name, const char *text, size_t size,
                       struct error *error)
{
    while (size > 0) {
        size_t bytes;
        const char *line_end = memchr(text, '\n', size);
        struct character_rig *rig =
            line_end ? parse_sheet_line(document, text, (size_t)(line_end - text), &bytes) : NULL;
        if (!rig) return fail(error, ERROR_INPUT, "%s: expected the paint of a character, got something else", name);
        size -= (size_t)(line_end + 1 - text);
        text = line_end + 1;
        if (bytes > size)
            return fail(error, ERROR_INPUT, "%s: expected %zu bytes of paint, got %zu", name, bytes, size);
        paint_drop(rig->painted);
        rig->painted = paint_parse(name, text, bytes, error);
        if (!rig->painted) return false;
        text += bytes;
        size -= bytes;
    }
    return true;
}
