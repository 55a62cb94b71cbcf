/// Gives the JSON library its memory.
#include "base/json.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

static void *take(size_t size) { return need(size, 1); }

/// Runs before main(), so that the library allocates everything with need().
__attribute__((constructor)) static void give_memory(void) { json_set_alloc_funcs(take, free); }

json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error)
{
    // At least the memory that the library needs for a text: its token buffer grows to twice the text, and each value, member, list and
    // object begins with one of these characters.
    enum { VALUE = 256, TOKEN = 4, BASIS = 4096 };
    size_t values = 0;
    for (size_t i = 0; i < size; i++) values += text[i] == ',' || text[i] == ':' || text[i] == '{' || text[i] == '[';
    if (need_has_room(VALUE * values + TOKEN * size + BASIS)) return json_loadb(text, size, flags, error);
    if (error) {
        strcpy(error->text, "out of memory");
        error->text[JSON_ERROR_TEXT_LENGTH - 1] = (char)json_error_out_of_memory; // where json_error_code() looks
    }
    return NULL;
}
