/// Loads documents that must be valid from text or files, and prints them as canonical text.
#ifndef TESTS_DOCUMENTS_H
#define TESTS_DOCUMENTS_H

#include "near.h"

#include "scene/load.h"
#include <jansson.h>

/// JSON that is written with ' for ". Valid until some calls later.
static inline const char *json(const char *text)
{
    static char texts[4][1 << 13];
    static int next;
    char *at = texts[next = (next + 1) % 4];
    snprintf(at, sizeof texts[0], "%s", text);
    for (char *c = at; *c; c++)
        if (*c == '\'') *c = '"';
    return at;
}

static inline struct document *document_of_text(const char *text)
{
    struct document *document;
    assert_done(document = scene_parse("scene.json", text, strlen(text), NULL, &error));
    return document;
}

static inline struct document *document_of_file(const char *path)
{
    struct document *document;
    assert_done(document = scene_load(path, NULL, &error));
    return document;
}

/// Its first character, or NULL.
static inline struct model_rig *first_model(const struct document *document)
{
    const int rig = document_find_rig(document, RIG_MODEL, 0);
    return rig >= 0 ? &document->rigs[rig]->model : NULL;
}

/// The caller frees it.
static inline char *text_of_document(const struct document *document)
{
    size_t size;
    char *text = scene_print(document, document->folder, NULL, &size);
    assert_non_null(text);
    assert_int_equal(strlen(text), size);
    return text;
}

static inline void assert_prints(const struct document *document, const char *expected)
{
    char *text = text_of_document(document);
    assert_string_equal(text, expected);
    free(text);
}

/// Saving, loading and printing gives the same text.
static inline void assert_loads_again(const struct document *document)
{
    char *text = text_of_document(document);
    struct document *again = document_of_text(text);
    assert_prints(again, text);
    document_destroy(again);
    free(text);
}

/// Where a path leads in a file: names, and elements of lists by their letter: "s1.k0.value" is splines[1].knots[0].value. "s#" is how many
/// splines there are. Compact JSON, "" where it leads nowhere; the caller frees it.
static inline char *fact_of(const struct document *document, const char *path)
{
    static const char *const lists[] = {"splines", "knots", "rigs", "channels", "pins", "drives"};
    char *text = text_of_document(document), names[128], *rest = names, *name;
    json_t *root = json_loads(text, 0, NULL), *at = root, *count = NULL;
    snprintf(names, sizeof names, "%s", path);
    while ((name = strsep(&rest, "."))) {
        for (int i = 0; i < 6 && (name[1] == '#' || (name[1] >= '0' && name[1] <= '9')); i++)
            if (lists[i][0] == *name) at = json_object_get(at, *name == 'd' ? "coordinates" : lists[i]);
        if (name[1] == '#')
            at = count = json_integer((json_int_t)json_array_size(at));
        else
            at = json_is_array(at) ? json_array_get(at, (size_t)atoi(name + 1)) : json_object_get(at, name);
    }
    char *fact = at ? json_dumps(at, JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(10)) : strdup("");
    json_decref(count);
    json_decref(root);
    free(text);
    return fact;
}

/// Fails unless a document's file says all of it: "s1.name='x'; r#=2". `row` is who asks.
static inline void assert_file_says(const struct document *document, const char *facts, const char *row)
{
    char text[1024], *rest = text, *fact;
    snprintf(text, sizeof text, "%s", json(facts));
    while ((fact = strsep(&rest, ";"))) {
        char *path = fact + strspn(fact, " "), *expected = strchr(path, '=');
        *expected++ = '\0';
        char *found = fact_of(document, path);
        if (strcmp(found, expected) != 0) fail_msg("%s: %s is %s, not %s", row, path, found, expected);
        free(found);
    }
}

#endif
