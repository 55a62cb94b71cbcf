/// What the scene layer knows of each kind of rig: its members in the file, and what drives it. Private to src/scene.
#ifndef SCENE_RIG_KIND_H
#define SCENE_RIG_KIND_H

#include "scene/members.h"
#include "scene/reader.h"

enum field_kind {
    FIELD_OWN, ///< read and printed by functions of its own, if any
    FIELD_NUMBER,
    FIELD_WHOLE,
    FIELD_FLAG,
    FIELD_NUMBERS, ///< an array of them
    FIELD_TEXT,
    FIELD_PATH,
    FIELD_SPLINE, ///< the index of the spline that is named
};

/// A member of a rig's object. Loading, printing, copying and freeing go by these rows.
struct field {
    const char *key;
    enum field_kind kind;
    size_t place, size; ///< in struct rig
    struct range range;
    bool is_optional; ///< a text that may be missing
    void (*load)(struct reader *reader, const struct value *object, struct rig *rig);
    void (*print)(struct members *members, const struct document *document, const struct rig *rig,
                  const char *folder);
};

/// A row's key and place; ranges of numbers.
#define FIELD(name, kind_of, member)                                                                                 \
    .key = name, .kind = kind_of, .place = offsetof(struct rig, member), .size = sizeof(((struct rig *)0)->member)
#define FIELD_ANY                                                                                                    \
    {                                                                                                                \
        -INFINITY, INFINITY, false                                                                                   \
    }
#define FIELD_POSITIVE                                                                                               \
    {                                                                                                                \
        0, INFINITY, true                                                                                            \
    }

struct rig_functions {
    const char *word;           ///< in the file
    const struct field *fields; ///< in the order of the file, up to one without a key; type, name and pins aside
    bool is_named;              ///< its name is required; else `title` is the place of what it goes by without
    size_t title;
    const char *pin_key; ///< what a point that can be pinned is called; NULL: none can
    /// By channels: these are copied, counted and freed for all such kinds in one place, and the functions below leave them alone.
    bool is_bent;
    holds_tracks *has_tracks; ///< which keys of its extra object belong to tracks; NULL: none
    /// Sets what is not zero where a file does not say; NULL: nothing.
    void (*reset)(struct rig *rig);
    /// Looks up what it names among the rigs, all of which are read; NULL: nothing.
    void (*resolve)(struct reader *reader, const struct value *object, struct rig *rig);
    /// Gives a shallow copy memory of its own for what fields do not own; NULL, as the next two: there is none.
    void (*copy)(struct rig *copy);
    void (*release)(struct rig *rig);
    size_t (*bytes)(const struct rig *rig, const struct rig *other); ///< that it owns and another (or NULL) does not
    bool (*equals)(const struct rig *a, const struct rig *b);        ///< in what fields do not have
};

#define RIG_FUNCTIONS(constant, name) extern const struct rig_functions name##_functions;
RIG_KIND_LIST(RIG_FUNCTIONS)
#undef RIG_FUNCTIONS

/// `joints` of the functions below: how many the rig has, or JOINTS_UNKNOWN where only its model says.
enum { JOINTS_UNKNOWN = 0 };

/// A number for all joints, an array of one for each or a ramp, whose unknown keys go into the object `*extra` under the value's key. A
/// missing value leaves `angles` alone.
void load_angles(struct reader *reader, struct value value, int joints, struct angles *angles, json_t **extra);
void print_angles(struct members *members, const char *key, const struct angles *angles, json_t *extra);

/// Reads one from its object, or from that of its rig, with its unknown keys. `axes` are the words for its axis.
void load_channel(struct reader *reader, const struct value *object, const char *const *axes, int joints,
                  struct channel *channel, json_t *extra);

/// Reads the member "channels", and prints it.
void load_channels(struct reader *reader, const struct value *object, const char *const *axes, int joints,
                   struct rig *rig);
void print_channels(struct members *members, const struct document *document, const struct rig *rig,
                    const char *folder);

/// Paint in a scene's file: "vertices", and "paint", an array of a string for each coordinate, or null for one without paint: base64 of its
/// vertices' a and ψ, little-endian float32; or the name of its .npy file, which alone is printed where that could not be read. Paint that
/// changes nothing is not printed.
void paint_load(struct reader *reader, const struct value *object, struct rig *rig);
void paint_print(struct members *members, const struct document *document, const struct rig *rig, const char *folder);

/// Keys of a channel's object.
extern const char *const channel_keys[];

#endif
