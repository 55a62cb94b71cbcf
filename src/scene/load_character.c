#include "scene/reader.h"
#include <stdlib.h>
#include <string.h>

static const char *const character_keys[] = {"type",        "name",   "model", "position",
                                             "coordinates", "phases", "paint", NULL};
static const char *const axes[] = {"x", "y", "z", NULL};
static const char *const drive_keys[] = {"name", "spline", "amplitude", "lag", NULL};

static void load_position(struct reader *reader, const struct where *at, const json_t *value, double position[3])
{
    if (!value || !reader_array(reader, at, value, 3, "[x, y, z]")) return;
    for (size_t i = 0; i < 3; i++) {
        struct where element_at = {.parent = at, .index = i};
        reader_number(reader, &element_at, json_array_get(value, i), true, range_any, &position[i]);
    }
}

static void load_drive(struct reader *reader, const struct where *at, json_t *object, struct drive *drive)
{
    struct where name_at, spline_at, amplitude_at, lag_at;
    const json_t *name = reader_member(at, object, "name", &name_at);
    const json_t *spline = reader_member(at, object, "spline", &spline_at);
    const json_t *amplitude = reader_member(at, object, "amplitude", &amplitude_at);
    const json_t *lag = reader_member(at, object, "lag", &lag_at);
    drive->amplitude = DRIVE_DEFAULT_AMPLITUDE;
    char *text = reader_name(reader, &name_at, name);
    if (text) drive->name = document_keep_text(reader->document, text);
    if (text && !drive->name) reader_no_memory(reader);
    free(text);
    drive->spline = reader_spline_name(reader, &spline_at, spline);
    reader_number(reader, &amplitude_at, amplitude, false, range_any, &drive->amplitude);
    reader_number(reader, &lag_at, lag, false, range_any, &drive->lag);
    drive->extra = reader_keep(reader, reader_extra(reader, at, object, drive_keys));
}

void load_character(struct reader *reader, const struct where *at, json_t *object, struct character_rig *rig)
{
    struct where name_at, model_at, position_at, coordinates_at, phases_at, paint_at;
    const json_t *name = reader_member(at, object, "name", &name_at);
    const json_t *model = reader_member(at, object, "model", &model_at);
    const json_t *position = reader_member(at, object, "position", &position_at);
    const json_t *coordinates = reader_member(at, object, "coordinates", &coordinates_at);
    const json_t *phases = reader_member(at, object, "phases", &phases_at);
    const json_t *paint = reader_member(at, object, "paint", &paint_at);
    if (name) rig->name = reader_name(reader, &name_at, name);
    rig->model = reader_name(reader, &model_at, model);
    if (paint) rig->paint = reader_name(reader, &paint_at, paint);
    load_position(reader, &position_at, position, rig->position);
    rig->phases = phases ? reader_word(reader, &phases_at, phases, axes, -1) : -1;
    int count = reader_objects(reader, &coordinates_at, coordinates, CHARACTER_MAX_DRIVES);
    for (int i = 0; i < count; i++) {
        struct where drive_at = {.parent = &coordinates_at, .index = (size_t)i};
        load_drive(reader, &drive_at, json_array_get(coordinates, (size_t)i), &rig->drives[i]);
    }
    rig->drive_count = count > 0 ? count : 0;
    rig->extra = reader_keep(reader, reader_extra(reader, at, object, character_keys));
}
