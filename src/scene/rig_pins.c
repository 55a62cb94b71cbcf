/// Reads and writes the pins of rigs.
#include "scene/pins.h"
#include "scene/rig_kind.h"
#include <limits.h>

static bool load_pin(struct reader *reader, struct value object, const char *key, int points, struct pin *pin)
{
    const char *const keys[] = {"frame", key, "to", NULL};
    const struct value point = reader_member(&object, key), to = reader_member(&object, "to");
    *pin = (struct pin){.id = reader->document->next_id++};
    bool good = reader_number(reader, reader_member(&object, "frame"), true, range_any, &pin->frame);
    if (!point.json) good = reader_unexpected(reader, point, "a whole number");
    good &= reader_integer(reader, point, 0, points - 1, &pin->point);
    good &= reader_array(reader, to, 3, "[x, y, z]");
    if (good) reader_point(reader, to, pin->to);
    pin->extra = reader_keep(reader, reader_extra(reader, &object, keys));
    return good;
}

void load_pins(struct reader *reader, const struct value *object, const char *key, struct rig *rig)
{
    const struct value pins = reader_member(object, "pins");
    const int count = reader_objects(reader, pins, SCENE_MAX_PINS);
    if (count <= 0) return;
    if (pins_count(reader->document) + count > SCENE_MAX_PINS) {
        reader_fail(reader, &pins.at, "expected at most %d pins over all rigs, got more", SCENE_MAX_PINS);
    } else {
        const int points = rig->kind == RIG_TAIL ? rig->tail.joints : INT_MAX;
        struct pin pin;
        for (int i = 0; i < count; i++) {
            if (load_pin(reader, reader_element(&pins, i), key, points, &pin)) pins_insert(rig, &pin);
        }
    }
}

void print_pins(struct members *members, const struct rig *rig, const char *key)
{
    struct text *text = members->text;
    if (rig->pin_count == 0) return;
    member(members, "pins");
    for (int i = 0; i < rig->pin_count; i++) {
        const struct pin *pin = &rig->pins[i];
        struct members own = {text, "{ ", ", ", false};
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        member_number(&own, "frame", pin->frame);
        member_number(&own, key, pin->point);
        member(&own, "to");
        text_numbers(text, pin->to, 3);
        members_extra(&own, pin->extra, NULL);
        text_string(text, " }");
    }
    text_string(text, "\n      ]");
}

/// Where a pin is in its file, in which ids rise: the index of a rig's pin in order of frames is another.
static size_t index_in_file(const struct rig *rig, int pin)
{
    size_t index = 0;
    for (int i = 0; i < rig->pin_count; i++) index += rig->pins[i].id < rig->pins[pin].id;
    return index;
}

void validate_pins(struct reader *reader, const struct where *scene_at)
{
    struct pin_trouble trouble;
    const struct document *document = reader->document;
    if (pins_check(document, &trouble) && pins_check_order(document, &trouble)) return;
    const struct rig *rig = document->rigs[trouble.rig];
    const struct where rigs_at = {.parent = scene_at, .key = "rigs"};
    const struct where rig_at = {.parent = &rigs_at, .index = (size_t)trouble.rig};
    const struct where pins_at = {.parent = &rig_at, .key = trouble.pin >= 0 ? "pins" : trouble.member};
    const struct where at = {.parent = &pins_at, .index = trouble.pin >= 0 ? index_in_file(rig, trouble.pin) : 0};
    const struct where member_at = {.parent = &at, .key = trouble.member};
    reader_fail(reader, trouble.pin >= 0 ? &member_at : &pins_at, "%s", trouble.error.text);
}
