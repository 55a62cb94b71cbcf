/// Knots on the clipboard, JSON or CSV: pasted, copied, pasted and copied they are the same.
#include "fuzz.h"
#include "scene/knots.h"
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct error error = {0};
    struct knot_list list, again;
    char *text = strndup((const char *)data, size);
    bool good = knots_parse("clipboard", text, &list, &error);
    free(text);
    fuzz_expect(good == (error.kind == ERROR_NONE), "knots are refused with a sentence");
    if (!good) return 0;
    char *first = knots_print(&list);
    fuzz_expect(knots_parse("again", first, &again, &error), error.text);
    char *second = knots_print(&again);
    fuzz_same("knots that are copied, pasted and copied are the same", first, strlen(first), second, strlen(second));
    free(first);
    free(second);
    knot_list_free(&list);
    knot_list_free(&again);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_json(data, size, most, 0, size, seed);
}
