/// Changes in the text of a glTF file, as an export makes them: what comes out says what changing its JSON would have said.
#include "export/gltf_splice.h"
#include "fuzz.h"
#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static const char clip[] = "{\"name\":\"wag\"}", length[] = "12";

/// Appends to an array of the root, in both; false where there is something else.
static bool append(json_t *json, struct splice *splice, const char *name)
{
    if (!json_object_get(json, name)) json_object_set_new(json, name, json_array());
    json_t *array = json_object_get(json, name);
    if (!json_is_array(array)) return false;
    json_array_append_new(array, json_loads(clip, 0, NULL));
    splice_append(splice, name, clip);
    return true;
}

/// Replaces an element or a member of one, in both, where there is one.
static void replace(json_t *json, struct splice *splice, const char *name, size_t index, const char *member)
{
    json_t *array = json_object_get(json, name), *old = json_array_get(array, index);
    if (!member && old) {
        json_array_set_new(array, index, json_loads(clip, 0, NULL));
        splice_replace(splice, name, index, NULL, clip);
    } else if (json_object_get(old, member)) {
        json_object_set_new(old, member, json_integer(atoi(length)));
        splice_replace(splice, name, index, member, length);
    }
}

static void expect_same(const json_t *json, struct splice *splice)
{
    char *text = splice_apply(splice);
    fuzz_expect(text != NULL, "a place that is there is found");
    json_t *read = json_loads(text, 0, NULL);
    if (!read || !json_equal(read, json)) fprintf(stderr, "%s\n", text);
    fuzz_expect(read && json_equal(read, json), "changed text says what changed JSON says");
    json_decref(read);
    free(text);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (memchr(data, '\0', size)) return 0; // glb_open() refuses it
    json_t *json = json_loadb((const char *)data, size, 0, NULL);
    char *text = strndup((const char *)data, size);
    struct splice splice = {.text = text};
    if (json_object_size(json) > 0) {
        replace(json, &splice, "animations", 1, NULL);
        replace(json, &splice, "buffers", 0, "byteLength");
        if (append(json, &splice, "accessors") && append(json, &splice, "bufferViews")) expect_same(json, &splice);
    }
    splice_free(&splice);
    free(text);
    json_decref(json);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    return fuzz_mutate_json(data, size, most, 0, size, seed);
}
