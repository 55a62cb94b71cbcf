/// Changes to a JSON text that leave every other byte of it as it is. Private to src/export.
#ifndef EXPORT_JSON_SPLICE_H
#define EXPORT_JSON_SPLICE_H

#include <stdbool.h>
#include <stddef.h>

/// From the first byte of a value to the one behind its last.
struct json_span {
    size_t start, end;
};

/// The value that a text consists of, which must be valid JSON, as for the next two.
struct json_span json_span_of(const char *text);

/// The value of an object's member, or an element of an array; false where there is none.
bool json_span_member(const char *text, struct json_span object, const char *key, struct json_span *value);
bool json_span_element(const char *text, struct json_span array, size_t index, struct json_span *value);

/// A change: bytes that are replaced by a text.
struct json_splice {
    size_t at, removed;
    char *text;
};

enum { JSON_MOST_SPLICES = 4096 };

struct json_splices {
    struct json_splice list[JSON_MOST_SPLICES];
    int count;
    bool failed; ///< one was one too many, or its text was NULL
};

/// Replaces a span; takes the text over. Changes must not overlap.
void json_replace(struct json_splices *splices, struct json_span span, char *text);

/// Adds elements ("{…}, {…}") behind an array's last, or members ("\"a\": 1") behind an object's `{`.
void json_append(struct json_splices *splices, const char *text, struct json_span array, char *elements);
void json_prepend(struct json_splices *splices, const char *text, struct json_span object, char *members);

/// The changed text, which the caller frees; NULL if memory is short or a change failed.
char *json_spliced(const char *text, struct json_splices *splices, size_t *size);

void json_splices_free(struct json_splices *splices);

#endif
