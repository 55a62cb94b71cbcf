/// Changes in the text of a JSON file that leave every other byte as it is. Private to src/export.
#ifndef EXPORT_GLTF_SPLICE_H
#define EXPORT_GLTF_SPLICE_H

#include <stdbool.h>
#include <stddef.h>

enum { SPLICE_EDITS = 8 };

/// All zero but `text`, which must be valid JSON whose root is an object with members.
struct splice {
    const char *text;
    struct splice_edit {
        size_t at, removed;
        char *added; ///< owned
    } edits[SPLICE_EDITS];
    int count;
    bool failed; ///< memory was short; stays set
};

/// Appends a value to an array of the root, which is made where it is missing. `value` is copied.
void splice_append(struct splice *splice, const char *array, const char *value);

/// Replaces an element of an array of the root, or that element's member.
void splice_replace(struct splice *splice, const char *array, size_t index, const char *member, const char *value);

/// The text with all changes; the caller frees it. NULL if memory was short.
char *splice_apply(struct splice *splice);
void splice_free(struct splice *splice);

#endif
