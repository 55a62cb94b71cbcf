/// Writes an object's members, known keys first.
#include "scene/members.h"
#include "base/file.h"

void member(struct members *members, const char *key)
{
    text_string(members->text, members->any ? members->separator : members->open);
    text_quoted(members->text, key);
    text_string(members->text, ": ");
    members->any = true;
}

void member_number(struct members *members, const char *key, double value)
{
    member(members, key);
    text_number(members->text, value);
}

void member_flag(struct members *members, const char *key, bool value)
{
    member(members, key);
    text_string(members->text, value ? "true" : "false");
}

void member_string(struct members *members, const char *key, const char *string)
{
    member(members, key);
    text_quoted(members->text, string);
}

void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                 const char *folder)
{
    char moved[PATH_LIMIT];
    member_string(members, key, path_rebase(path, document->folder, folder, moved) ? moved : path);
}

void members_extra(struct members *members, json_t *extra, holds_tracks *skips)
{
    const char *key;
    json_t *value;
    json_object_foreach(extra, key, value)
    {
        if (skips && skips(key)) continue;
        member(members, key);
        text_json(members->text, value);
    }
}

void text_numbers(struct text *text, const double *values, int count)
{
    text_string(text, "[");
    for (int i = 0; i < count; i++) {
        if (i > 0) text_string(text, ", ");
        text_number(text, values[i]);
    }
    text_string(text, "]");
}

void print_param(struct text *text, const struct document *document, const struct param *param, json_t *extras,
                 const char *key, const char *folder)
{
    if (!param_follows(param)) {
        text_number(text, param->value);
        return;
    }
    struct members track = {text, "{ ", ", ", false};
    if (param->motion) {
        print_motion(&track, document, param, folder);
    } else {
        member_string(&track, "spline", document->splines[param->track]->name);
    }
    members_extra(&track, json_object_get(extras, key), NULL);
    text_string(text, " }");
}
