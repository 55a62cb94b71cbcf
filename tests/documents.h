/// Loads documents that must be valid from text or files, and prints them as canonical text.
#ifndef TESTS_DOCUMENTS_H
#define TESTS_DOCUMENTS_H

#include "near.h"

#include "scene/load.h"

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

/// The caller frees it.
static inline char *text_of_document(const struct document *document)
{
    size_t size;
    char *text = scene_print(document, &size);
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

#endif
