/// The scene layer's data of each kind of rig: its members in the file, and its drives. Private to src/scene.
#ifndef SCENE_RIG_KIND_H
#define SCENE_RIG_KIND_H

#include "scene/fields.h"

struct rig_functions {
    const char *word;           ///< in the file
    const struct field *fields; ///< in the order of the file
    size_t title;               ///< place of the text that names it if it has no name
    const struct field *pins;   ///< the rows of a pin; NULL: it takes none
    bool is_bent;               ///< by channels
};

#define RIG_FUNCTIONS(constant, name) extern const struct rig_functions name##_functions;
RIG_KIND_LIST(RIG_FUNCTIONS)
#undef RIG_FUNCTIONS

/// The rows of a rig's pins, or NULL.
const struct field *rig_pin_fields(const struct rig *rig);

/// The members that every kind of rig begins with, and its pins, which are its last.
#define RIG_FIRST(needs_name)                                                                                        \
    {.key = "type", .print = print_type},                                                                            \
    {                                                                                                                \
        FIELD("name", FIELD_TEXT, struct rig, name), .is_required = needs_name, .is_apart = true                     \
    }
#define RIG_PINS(rows_of)                                                                                            \
    {                                                                                                                \
        FIELD_LIST_OF("pins", struct rig, pins, pin_count, rows_of, SCENE_MAX_PINS),                                 \
            .load = load_pins, .is_quiet = true, .is_apart = true                                                    \
    }
void print_type(struct members *members, const struct document *document, const void *rig, const char *folder);
void load_pins(struct reader *reader, const struct value *object, void *rig);

/// Paint in a scene's file: "vertices", and "paint", an array of a string for each coordinate, or null for one without paint: base64 of its
/// vertices' a and ψ, little-endian float32; or the name of its .npy file, which alone is printed where that could not be read. Paint that
/// changes nothing is not printed.
void paint_load(struct reader *reader, const struct value *object, void *rig);
void paint_print(struct members *members, const struct document *document, const void *rig, const char *folder);

#endif
