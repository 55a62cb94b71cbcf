#include "scene/print_character.h"
#include "base/path.h"
#include "scene/members.h"

static const char *const axis_names[] = {"x", "y", "z"};

static void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                        const char *folder)
{
    char moved[PATH_LIMIT];
    member_string(members, key, path_rebase(path, document->folder, folder, moved) ? moved : path);
}

static void print_drive(struct text *text, const struct document *document, const struct drive *drive)
{
    struct members members = {text, "{ ", ", ", false};
    member_string(&members, "name", drive->name);
    member_string(&members, "spline", document->splines[drive->spline].name);
    member_number(&members, "amplitude", drive->amplitude);
    member_number(&members, "lag", drive->lag);
    members_extra(&members, drive->extra, NULL);
    text_string(text, " }");
}

/// Paint that was taken away again, or that does nothing, needs no file; one that could not be read stays named.
static bool is_painted(const struct character_rig *rig)
{
    if (!rig->paint) return false;
    return rig->painted ? !paint_is_plain(rig->painted) : rig->filed == 0;
}

void print_character(struct text *text, const struct document *document, const struct character_rig *rig,
                     const char *folder)
{
    struct members members = {text, "    {\n      ", ",\n      ", false};
    member_string(&members, "type", "character");
    if (rig->name) member_string(&members, "name", rig->name);
    member_path(&members, "model", document, rig->model, folder);
    member(&members, "position");
    text_numbers(text, rig->position, 3);
    member(&members, "coordinates");
    for (int i = 0; i < rig->drive_count; i++) {
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        print_drive(text, document, &rig->drives[i]);
    }
    text_string(text, rig->drive_count > 0 ? "\n      ]" : "[]");
    if (rig->phases >= 0) member_string(&members, "phases", axis_names[rig->phases]);
    if (is_painted(rig)) member_path(&members, "paint", document, rig->paint, folder);
    members_extra(&members, rig->extra, NULL);
    text_string(text, "\n    }");
}
