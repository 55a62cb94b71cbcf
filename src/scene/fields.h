/// The file being read, its problems, and readers of single values; objects, printed key by key; and described by rows, one per member, to be
/// read, printed, checked, compared, copied and freed. Private to src/scene.
///
/// A reader reports a problem, leaves its target unchanged and lets the loader continue with the next value.
#ifndef SCENE_FIELDS_H
#define SCENE_FIELDS_H

#include "scene/document.h"
#include "scene/text.h"
#include <jansson.h>

// --- the text: its limits, and the lines and paths for messages; jansson gives positions of syntax errors only

enum {
    SOURCE_MAX_BYTES = 256 << 20,
    SOURCE_MAX_DEPTH = 64,        ///< levels of brackets
    SOURCE_MAX_OBJECTS = 2000000, ///< and
    SOURCE_MAX_VALUES = 8000000,  ///< bound the memory that parsing takes
    PATH_TEXT_SIZE = 256,
};

/// A place in a file: a key or an index below another place. The root has no parent.
struct where {
    const struct where *parent;
    const char *key; ///< NULL: an element of an array
    size_t index;
};

/// A position in the text, before a token.
struct cursor {
    const char *at;
    int line;
};

/// Where the last element looked up in an array was, so that messages in file order take linear time in all.
struct finger {
    const char *array;
    size_t index;
    struct cursor cursor;
};

struct source {
    const char *name; ///< the file, for messages
    const char *text; ///< followed by a NUL
    size_t size;
    struct finger fingers[SOURCE_MAX_DEPTH];
};

// --- values

enum { READER_MAX_WARNED = 64 };

/// Splines by name, for tracks and channels.
struct name_index {
    const char *name;
    int spline;
};

struct reader {
    struct source source;
    struct problems *problems; ///< NULL: only the first error counts
    struct error *error;       ///< the first error
    int errors;
    struct document *document;
    const struct rig *rig;      ///< being read
    int places[SCENE_MAX_RIGS]; ///< of the document's rigs in the file
    json_t *meadows;            ///< of an old file; NULL: none
    bool has_domain;            ///< frames, fps and substeps are valid
    size_t knot_count;          ///< over all splines
    int limited_count;          ///< splines with a low or high limit
    struct name_index *names;   ///< sorted; one a spline
    int name_count;
    const char *warned[READER_MAX_WARNED]; ///< unknown keys that were warned about: once each
    int warned_count;
};

/// Where a number may lie.
struct range {
    double minimum, maximum;
    bool above; ///< the minimum itself is excluded
};

extern const struct range range_any;

static inline bool range_has(struct range range, double number)
{
    return (range.above ? number > range.minimum : number >= range.minimum) && number <= range.maximum;
}

/// Reports "file:line: path: sentence" as an error; returns false.
bool reader_fail(struct reader *reader, const struct where *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// The same with a complete sentence; or a warning.
bool reader_report(struct reader *reader, bool is_error, const struct error *problem);

/// Like reader_fail(), but a warning; does nothing without `problems`.
void reader_warn(struct reader *reader, const struct where *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// A value in the file and its place. The places above it must outlive it.
struct value {
    struct where at;
    json_t *json; ///< NULL: it is missing
};

/// The value under a key of an object, and an element of an array.
struct value reader_member(const struct value *object, const char *key);
struct value reader_element(const struct value *array, int index);

/// Fails with "expected …, got …", naming the kind of value that is there.
bool reader_unexpected(struct reader *reader, struct value value, const char *expected);

/// Reads a number in a range. A missing one leaves `*target` alone, and is an error only if it is required.
bool reader_number(struct reader *reader, struct value value, bool required, struct range range, double *target);

/// Reads an optional whole number from minimum to maximum (120, 120.0 and 1.2e2 are the same).
bool reader_integer(struct reader *reader, struct value value, int minimum, int maximum, int *target);

/// Reads an optional true or false.
void reader_flag(struct reader *reader, struct value value, bool *target);

enum { WORDS_TEXT = 128 };

/// "a", "b" or "c": words that NULL ends, without empty ones.
const char *list_words(const char *const *words, char text[WORDS_TEXT]);

/// Index of a string among `words` (list_words()); -1 after an error.
int reader_word(struct reader *reader, struct value value, const char *const *words);

/// The reader's text as JSON; NULL after an error (syntax, too deep, too much).
json_t *reader_parse(struct reader *reader);

/// A copy of a required, non-empty string; NULL after an error.
char *reader_name(struct reader *reader, struct value value);

/// The same for a path as text_path() writes it.
char *reader_path(struct reader *reader, struct value value);

/// Length of an optional array of at most `limit` objects; 0 if it is missing, -1 after an error.
int reader_objects(struct reader *reader, struct value value, int limit);

/// Whether a value is an array of `count` elements; fails with "expected `expected`, got …" if not.
bool reader_array(struct reader *reader, struct value value, size_t count, const char *expected);

/// Index of the spline that a required string names; -1 after an error.
int reader_spline_name(struct reader *reader, struct value value);

/// Warns of an object's members that are not among `known` (which ends with NULL). Returns them as a new object, or NULL.
json_t *reader_extra(struct reader *reader, const struct value *object, const char *const *known);

/// Puts unknown keys (or NULL) into the object `*extra`, which is made if it is NULL, under a key.
void reader_put(json_t **extra, const char *key, json_t *unknown);

/// Reads a number in a range, a track, `{"spline": "other"}`, or, if it may be one, the motion of a joint. Returns unknown keys of a track, for
/// reader_put().
json_t *reader_param(struct reader *reader, struct value value, struct range range, bool may_be_motion,
                     struct param *param);

/// Reads the motion of a joint.
void motion_load(struct reader *reader, const struct value *object, struct param *param);

/// Gives an object of unknown keys (or NULL) to the document.
json_t *reader_keep(struct reader *reader, json_t *extra);

/// A scene's rigs, into reader->document, which has its splines: rigs name them.
void load_rigs(struct reader *reader, const struct value *scene);

/// Looks up what motions name among the rigs, all of which are read.
void resolve_motions(struct reader *reader, const struct value *scene);

// --- objects, printed key by key

/// An object being written: `open` precedes its first member, `separator` the others.
struct members {
    struct text *text;
    const char *open, *separator;
    bool any;
};

/// Writes a key; its value follows.
void member(struct members *members, const char *key);
void member_number(struct members *members, const char *key, double value);
void member_string(struct members *members, const char *key, const char *string);

/// A path of the document, for a file in `folder`; with no document (NULL) as it is.
void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                 const char *folder);

/// Writes the unknown keys, except those that `skips` (may be NULL) marks as holding a member's unknown keys.
void members_extra(struct members *members, json_t *extra, bool (*skips)(const char *key));

/// A number, a track or a motion, for a file in `folder`; `extras` holds the unknown keys of the latter two, by `key`.
void print_param(struct text *text, const struct document *document, const struct param *param, json_t *extras,
                 const char *key, const char *folder);

/// The rigs as an array, with paths relative to `folder`, that of the file.
void print_rigs(struct text *text, const struct document *document, const char *folder);

/// [1, 2, 3]
void text_numbers(struct text *text, const double *values, int count);

// --- rows

enum field_kind {
    FIELD_OWN, ///< read and printed by functions of its own, if any
    FIELD_NUMBER,
    FIELD_WHOLE,
    FIELD_FLAG,
    FIELD_NUMBERS, ///< an array of two or three
    FIELD_WORD,    ///< one of several words
    FIELD_TEXT,
    FIELD_PATH,
    FIELD_MODEL,  ///< the name of a model rig, or its file
    FIELD_SPLINE, ///< the index of the named spline
    FIELD_PLACE,  ///< three numbers or splines to follow
    FIELD_ANGLES,
    FIELD_PAINT, ///< held, beside a row that reads and prints it
    FIELD_LIST,  ///< objects
};

enum { FIELDS_MOST = 16 }; ///< per object

/// A member of an object.
struct field {
    const char *key; ///< NULL in the last row, whose place is that of the unknown keys
    enum field_kind kind;
    size_t place, size;       ///< in its structure; the size of a list is that of an element
    struct range range;       ///< of numbers; how many elements a list may have
    double usual[3];          ///< defaults for missing members
    const char *const *words; ///< ended by NULL; an empty one is none
    const struct field *rows; ///< of a list's elements
    size_t count;             ///< place of the number of a list's elements
    size_t flag;              ///< place of a bool: whether there is a number (0: always)
    bool is_required;         ///< in the file
    bool is_quiet;            ///< not printed if it has its default
    bool is_apart;            ///< ignored when two objects are compared
    /// Instead of what the kind does.
    void (*load)(struct reader *reader, const struct value *object, void *at);
    void (*print)(struct members *members, const struct document *document, const void *at, const char *folder);
};

/// How a row begins, and the row of a list; then the last row, and two ranges of numbers.
#define FIELD(name, kind_of, type, member)                                                                           \
    .key = name, .kind = kind_of, .place = offsetof(type, member), .size = sizeof(((type *)0)->member)
#define FIELD_LIST_OF(name, type, member, number, rows_of, most)                                                     \
    .key = name, .kind = FIELD_LIST, .place = offsetof(type, member), .size = sizeof(((type *)0)->member[0]),        \
    .count = offsetof(type, number), .rows = rows_of, .range = {0, most, false}
#define FIELD_END(type)                                                                                              \
    {                                                                                                                \
        .place = offsetof(type, extra)                                                                               \
    }
#define FIELD_ANY                                                                                                    \
    {                                                                                                                \
        -INFINITY, INFINITY, false                                                                                   \
    }
#define FIELD_POSITIVE                                                                                               \
    {                                                                                                                \
        0, INFINITY, true                                                                                            \
    }

/// Sets all members to their defaults.
void fields_reset(const struct field *fields, void *at);

/// Reads the members; unknown keys of tracks and ramps go into `*extra`, which is made if it is NULL, by key.
void fields_load(struct reader *reader, const struct value *object, const struct field *fields, void *at,
                 json_t **extra);
/// Reads a whole object with its unknown keys. Members that it lacks get their defaults.
void object_load(struct reader *reader, const struct value *object, const struct field *fields, void *at);
/// Reads and prints the list that the row is about.
void list_load(struct reader *reader, const struct value *object, const struct field *field, void *at);
void list_print(struct members *members, const struct document *document, const struct field *field, const void *at,
                const char *folder);

/// Prints all members, the unknown ones last.
void fields_print(struct members *members, const struct document *document, const struct field *fields,
                  const void *at, const char *folder);

/// Whether a document may have it as an edit made it; −0 becomes 0. `joints` as in check_angles().
bool fields_check(const struct document *document, int joints, const struct field *fields, void *at,
                  struct error *error);
bool fields_equal(const struct field *fields, const void *a, const void *b);

/// Gives a shallow copy memory of its own.
void fields_copy(const struct field *fields, void *copy);
void fields_free(const struct field *fields, void *at);
/// Bytes behind pointers, but for paint that `other` (may be NULL) has, too.
size_t fields_bytes(const struct field *fields, const void *at, const void *other);

/// The row of a key, or NULL.
const struct field *fields_find(const struct field *fields, const char *key);

/// The rows of a rig; and those of its pins.
const struct field *rig_fields(const struct rig *rig);
const struct field *rig_pin_fields(const struct rig *rig);

/// Whether there is a model rig with that name, or with that file.
bool has_model(const struct document *document, const char *text, struct error *error);

/// Whether a spline's equilibrium may follow it; −0 becomes 0, and its model is looked up.
bool motion_check(const struct document *document, struct joint_motion *motion, struct error *error);

extern const struct field knot_fields[], knot_list_field, motion_fields[], background_fields[];

// --- angles

/// A rig's joints, where only its model says how many there are.
enum { JOINTS_UNKNOWN = 0 };

/// A number for all joints, an array of one for each or a ramp, whose unknown keys go into the object `*extra` under the value's key. A
/// missing value leaves `angles` alone.
void load_angles(struct reader *reader, struct value value, struct angles *angles, json_t **extra);
void print_angles(struct members *members, const char *key, const struct angles *angles, json_t *extra);
bool check_angles(int joints, struct angles *angles, struct error *error);

#endif
