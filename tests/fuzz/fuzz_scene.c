/// Scene files: what one load and save gives, the next one gives again.
#include "fuzz.h"
#include "scene/load.h"
#include <stdlib.h>

static void ignore(void *user, bool is_error, const char *sentence) { (void)user, (void)is_error, (void)sentence; }

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct problems problems = {.report = ignore};
    struct document *document = scene_parse("fuzz.json", (const char *)data, size, &problems, &error);
    fuzz_expect(!document == (error.kind != ERROR_NONE), "a scene is refused with a sentence");
    if (!document) return 0;
    size_t first_size, second_size;
    char *first = scene_print(document, &first_size);
    struct document *again = scene_parse("again.json", first, first_size, NULL, &error);
    fuzz_expect(again != NULL, error.text);
    char *second = scene_print(again, &second_size);
    fuzz_same("a scene that is saved, loaded and saved is the same", first, first_size, second, second_size);
    free(first);
    free(second);
    document_destroy(document);
    document_destroy(again);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_json(data, size, most, 0, size, seed);
}
