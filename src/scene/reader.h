/// Shared by the loader's parts: the file being read, its problems, and readers of single values.
///
/// A reader reports a problem, leaves its target unchanged and lets the loader continue with the next value.
#ifndef SCENE_READER_H
#define SCENE_READER_H

#include "scene/document.h"
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

/// The same with a complete sentence.
bool reader_report(struct reader *reader, const struct error *error);

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

#endif
