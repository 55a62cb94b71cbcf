/// Recovery files: a scene under a first line, and paint behind it.
#include "app/recovery.h"
#include "fuzz.h"
#include "scene/load.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *text_of(const struct document *document, size_t *size)
{
    char *text = NULL;
    size_t capacity = 0;
    scene_print_into(document, RECOVERY_FOLDER, &text, &capacity, size);
    scene_print_paint(document, &text, &capacity, size);
    return text;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct recovery_slot slot = {.lock = -1};
    snprintf(slot.path, sizeof slot.path, "%s", fuzz_file("recovery", data, size));
    struct document *document = recovery_read(&slot, &error);
    fuzz_expect(!document == (error.kind != ERROR_NONE), "a recovery file is refused with a sentence");
    if (!document) return 0;
    size_t first_size, second_size;
    char *first = text_of(document, &first_size);
    fuzz_expect(recovery_write(&slot, "/scene.json", NULL, first, first_size, &error), error.text);
    struct document *again = recovery_read(&slot, &error);
    fuzz_expect(again != NULL, error.text);
    char *second = text_of(again, &second_size);
    fuzz_same("what is recovered is the same", first, first_size, second, second_size);
    free(first);
    free(second);
    document_destroy(document);
    document_destroy(again);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    const uint8_t *line = memchr(data, '\n', size), *nul = memchr(data, '\0', size);
    const size_t end = nul ? (size_t)(nul - data) : size, start = line ? (size_t)(line + 1 - data) : 0;
    return fuzz_mutate_json(data, size, most, start < end ? start : end, end, seed);
}
