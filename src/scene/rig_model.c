/// Imported characters as a kind of rig: loading, printing and memory.
#include "scene/rig_kind.h"
#include <math.h>
#include <stdlib.h>

static const char *const model_keys[] = {"type", "name", "model", "clip", "position", "scale", "turn", NULL};

static void load(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct model_rig *model = &rig->model;
    const struct value name = reader_member(object, "name"), clip = reader_member(object, "clip");
    const struct range positive = {0, INFINITY, true};
    model->scale = 1;
    if (name.json) rig->name = reader_name(reader, name);
    model->model = reader_name(reader, reader_member(object, "model"));
    if (clip.json) model->clip = reader_name(reader, clip);
    reader_point(reader, reader_member(object, "position"), model->position);
    reader_number(reader, reader_member(object, "scale"), false, positive, &model->scale);
    reader_number(reader, reader_member(object, "turn"), false, range_any, &model->turn);
    rig->extra = reader_keep(reader, reader_extra(reader, object, model_keys));
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct model_rig *model = &rig->model;
    member_path(members, "model", document, model->model, folder);
    if (model->clip) member_string(members, "clip", model->clip);
    member(members, "position");
    text_numbers(members->text, model->position, 3);
    member_number(members, "scale", model->scale);
    member_number(members, "turn", model->turn);
}

static void copy(struct rig *copy)
{
    char **const texts[] = {&copy->model.model, &copy->model.clip};
    rig_own_texts(texts, 2);
}

static void release(struct rig *rig)
{
    free(rig->model.model);
    free(rig->model.clip);
}

static size_t bytes(const struct rig *rig, const struct rig *other)
{
    (void)other;
    return text_size(rig->model.model) + text_size(rig->model.clip);
}

static const char *title(const struct rig *rig) { return rig->model.model; }

const struct rig_functions model_functions = {
    .word = "model", .load = load, .print = print, .copy = copy, .release = release, .bytes = bytes, .title = title};
