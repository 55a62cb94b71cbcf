/// The rigs of a scene: what kinds there are, and names of their own.
#include "scene/reader.h"
#include <stdlib.h>
#include <string.h>

enum rig_type { RIG_TAIL, RIG_CHARACTER };

static const char *const types[] = {[RIG_TAIL] = "tail", [RIG_CHARACTER] = "character", NULL};

/// Complains where a rig before this one has the same name.
static void check_name(struct reader *reader, const struct where *rig_at, const char *const *names, size_t index)
{
    struct where at = {.parent = rig_at, .key = "name"};
    for (size_t i = 0; i < index && names[index]; i++) {
        if (!names[i] || strcmp(names[i], names[index]) != 0) continue;
        reader_fail(reader, &at, "expected a name of its own, got \"%s\" as rigs[%zu] has", names[i], i);
        return;
    }
}

/// Reads one rig into the document's next tail or character; returns its name, NULL where it has none.
static const char *load_rig(struct reader *reader, const struct where *at, json_t *object)
{
    struct document *document = reader->document;
    struct where type_at;
    const json_t *type = reader_member(at, object, "type", &type_at);
    int word = reader_word(reader, &type_at, type, types, -1);
    if (word == RIG_TAIL) {
        struct tail *tail = &document->tails[document->tail_count++];
        load_tail(reader, at, object, tail);
        return tail->name;
    }
    if (word == RIG_CHARACTER) {
        struct character_rig *rig = &document->characters[document->character_count++];
        rig->tails_before = document->tail_count;
        load_character(reader, at, object, rig);
        return rig->name;
    }
    return NULL;
}

void load_rigs(struct reader *reader, const struct where *scene_at, const json_t *scene)
{
    struct where rigs_at;
    const json_t *rigs = reader_member(scene_at, scene, "rigs", &rigs_at);
    int count = reader_objects(reader, &rigs_at, rigs, SCENE_MAX_RIGS);
    if (count <= 0) return;
    struct document *document = reader->document;
    const char *names[SCENE_MAX_RIGS] = {NULL};
    document->tails = calloc((size_t)count, sizeof *document->tails);
    document->characters = calloc((size_t)count, sizeof *document->characters);
    if (!document->tails || !document->characters) {
        reader_no_memory(reader);
        return;
    }
    for (size_t i = 0; i < (size_t)count; i++) {
        struct where at = {.parent = &rigs_at, .index = i};
        names[i] = load_rig(reader, &at, json_array_get(rigs, i));
        check_name(reader, &at, names, i);
    }
}
