/// Watches the memory of the JSON library.
///
/// Its reader does not look whether the buffer for a token could grow, and ends the program soon after. So a block large enough for
/// that buffer is put by before it begins, is given out where memory runs short for the first time, and the text ends there.
#include "base/json.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

static once_flag watching = ONCE_FLAG_INIT;
static void *(*taken_from)(size_t size) = malloc;
static _Thread_local bool ran_short;
static _Thread_local struct {
    void *block;
    size_t size; ///< 0: given out
} reserve;

static void *take(size_t size)
{
    void *memory = taken_from(size);
    if (memory) return memory;
    ran_short = true;
    if (size > reserve.size) return NULL;
    reserve.size = 0;
    return reserve.block;
}

static void give_back(void *memory)
{
    if (memory != reserve.block) free(memory);
}

static void watch(void) { json_set_alloc_funcs(take, give_back); }

void json_read_with(void *(*allocate)(size_t size))
{
    call_once(&watching, watch);
    taken_from = allocate ? allocate : malloc;
}

struct text {
    const char *at, *end;
};

/// Byte by byte, for what the library has taken before memory ran short it would read to its end.
static size_t next_byte(void *buffer, size_t room, void *user)
{
    struct text *text = user;
    (void)room;
    if (ran_short || text->at == text->end) return 0;
    *(char *)buffer = *text->at++;
    return 1;
}

static json_t *read_reserved(const char *text, size_t size, size_t flags, json_error_t *error)
{
    struct text rest = {text, text + size};
    reserve.size = 2 * size + 64; // the buffer doubles, from 16 bytes
    reserve.block = taken_from(reserve.size);
    ran_short = !reserve.block;
    json_t *json = ran_short ? NULL : json_load_callback(next_byte, &rest, flags, error);
    if (ran_short) { // what there is may hold the reserve
        json_decref(json);
        json = NULL;
    }
    free(reserve.block);
    reserve.block = NULL;
    reserve.size = 0;
    return json;
}

json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error)
{
    call_once(&watching, watch);
    json_t *json = read_reserved(text, size, flags, error);
    if (ran_short && error) {
        strcpy(error->text, "out of memory");
        error->text[JSON_ERROR_TEXT_LENGTH - 1] = (char)json_error_out_of_memory; // where json_error_code() looks
    }
    return json;
}

char *json_print(const json_t *json, size_t flags)
{
    call_once(&watching, watch);
    ran_short = false;
    char *text = json_dumps(json, flags);
    if (!ran_short) return text;
    free(text);
    return NULL;
}
