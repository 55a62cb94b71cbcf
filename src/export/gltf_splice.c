/// Finds places in JSON text, and changes it there.
#include "export/gltf_splice.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *skip_space(const char *at) { return at + strspn(at, " \t\r\n"); }

static const char *skip_string(const char *at)
{
    for (at++; *at && *at != '"'; at++) {
        if (*at == '\\' && at[1]) at++;
    }
    return *at ? at + 1 : at;
}

/// Past the value that starts here.
static const char *skip_value(const char *at)
{
    int depth = 0;
    for (at = skip_space(at); *at;) {
        if (*at == '"') {
            at = skip_string(at);
        } else if (*at == '{' || *at == '[') {
            depth++;
            at++;
        } else if (*at == '}' || *at == ']') {
            if (depth == 0) return at;
            depth--;
            at++;
        } else if (*at == ',' && depth == 0) {
            return at;
        } else {
            at++;
            continue;
        }
        if (depth == 0) return at;
    }
    return at;
}

/// Whether the string that starts here says `key`, a name of letters, be they escaped or not.
static bool says(const char *string, const char *key)
{
    for (string++; *key; key++) {
        unsigned code;
        const bool escaped = strncmp(string, "\\u", 2) == 0 && sscanf(string + 2, "%4x", &code) == 1;
        if (escaped ? code != (unsigned char)*key : *string != *key) return false;
        string += escaped ? 6 : 1;
    }
    return *string == '"';
}

/// The value of a member of the object that starts here, or NULL; of two by one name the last, as readers of JSON have it.
static const char *find_member(const char *object, const char *key)
{
    const char *at = skip_space(object) + 1, *found = NULL;
    while (*(at = skip_space(at)) == '"') {
        const char *value = skip_space(skip_space(skip_string(at)) + 1);
        if (says(at, key)) found = value;
        at = skip_space(skip_value(value));
        if (*at == ',') at++;
    }
    return found;
}

/// An element of the array that starts here, or NULL.
static const char *find_element(const char *array, size_t index)
{
    const char *at = skip_space(skip_space(array) + 1);
    for (size_t i = 0; *at && *at != ']'; i++) {
        if (i == index) return at;
        at = skip_space(skip_value(at));
        if (*at == ',') at = skip_space(at + 1);
    }
    return NULL;
}

/// Takes `added` over.
static void add_edit(struct splice *splice, const char *at, size_t removed, char *added)
{
    if (!added || splice->count == SPLICE_EDITS) {
        free(added);
        splice->failed = true;
        return;
    }
    splice->edits[splice->count++] = (struct splice_edit){(size_t)(at - splice->text), removed, added};
}

void splice_append(struct splice *splice, const char *array, const char *value)
{
    const char *found = find_member(splice->text, array);
    char *added = NULL;
    if (!found) {
        if (asprintf(&added, "\"%s\":[%s],", array, value) < 0) added = NULL;
        add_edit(splice, skip_space(splice->text) + 1, 0, added);
        return;
    }
    const bool empty = *skip_space(skip_space(found) + 1) == ']';
    if (asprintf(&added, "%s%s", empty ? "" : ",", value) < 0) added = NULL;
    const char *close = skip_value(found) - 1;
    while (!empty && strchr(" \t\r\n", close[-1])) close--; // right behind the last element
    add_edit(splice, close, 0, added);
}

void splice_replace(struct splice *splice, const char *array, size_t index, const char *member, const char *value)
{
    const char *found = find_member(splice->text, array);
    const char *old = found ? find_element(found, index) : NULL;
    if (old && member) old = find_member(old, member);
    if (!old) {
        splice->failed = true;
        return;
    }
    const char *end = skip_value(old);
    while (strchr(" \t\r\n", end[-1])) end--;
    add_edit(splice, old, (size_t)(end - old), strdup(value));
}

static int by_place(const void *a, const void *b)
{
    const struct splice_edit *one = a, *other = b;
    return one->at < other->at ? -1 : one->at > other->at;
}

char *splice_apply(struct splice *splice)
{
    size_t size = strlen(splice->text) + 1, from = 0;
    for (int i = 0; i < splice->count; i++) size += strlen(splice->edits[i].added);
    char *result = splice->failed ? NULL : malloc(size), *at = result;
    if (!result) return NULL;
    qsort(splice->edits, (size_t)splice->count, sizeof *splice->edits, by_place);
    for (int i = 0; i < splice->count; i++) {
        const struct splice_edit *edit = &splice->edits[i];
        at = mempcpy(at, splice->text + from, edit->at - from);
        at = stpcpy(at, edit->added);
        from = edit->at + edit->removed;
    }
    strcpy(at, splice->text + from);
    return result;
}

void splice_free(struct splice *splice)
{
    for (int i = 0; i < splice->count; i++) free(splice->edits[i].added);
    splice->count = 0;
}
