/// Watches the memory of the JSON library.
#include "base/json.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <threads.h>

static once_flag watching = ONCE_FLAG_INIT;
static void *(*taken_from)(size_t size) = malloc;
static _Thread_local bool ran_short;

static void *take(size_t size)
{
    void *memory = taken_from(size);
    if (!memory) ran_short = true;
    return memory;
}

static void watch(void) { json_set_alloc_funcs(take, free); }

void json_read_with(void *(*allocate)(size_t size))
{
    call_once(&watching, watch);
    taken_from = allocate ? allocate : malloc;
}

json_t *json_read(const char *text, size_t size, size_t flags, json_error_t *error)
{
    call_once(&watching, watch);
    ran_short = false;
    json_t *json = json_loadb(text, size, flags, error);
    if (json || !ran_short) return json;
    strcpy(error->text, "out of memory");
    error->text[JSON_ERROR_TEXT_LENGTH - 1] = (char)json_error_out_of_memory; // where json_error_code() looks
    return NULL;
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
