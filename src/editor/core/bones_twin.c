/// The other side of a chain: left for right, right for left.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include <ctype.h>
#include <stdio.h>
#include <string.h>

/// Words for the sides. One letter counts only where it stands alone: ear_L, L.ear, ear.l.001.
static const char *const sides[][2] = {
    {"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}, {"L", "R"}, {"l", "r"}};

static bool stands_alone(const char *name, const char *at, size_t length)
{
    return length > 1 || ((at == name || !isalnum((unsigned char)at[-1])) && !isalnum((unsigned char)at[length]));
}

/// Where the word for a side is in a name, or NULL.
static const char *find_side(const char *name, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = strstr(name, word); at; at = strstr(at + 1, word)) {
        if (stands_alone(name, at, length)) return at;
    }
    return NULL;
}

/// The name of the twin of a bone; false where the name has no side.
static bool other_side(const char *name, char twin[BONES_NAME])
{
    for (size_t s = 0; s < sizeof sides / sizeof sides[0]; s++) {
        for (int left = 0; left < 2; left++) {
            const char *word = sides[s][left], *at = find_side(name, word);
            if (!at) continue;
            const int size =
                snprintf(twin, BONES_NAME, "%.*s%s%s", (int)(at - name), name, sides[s][1 - left], at + strlen(word));
            return size < BONES_NAME;
        }
    }
    return false;
}

/// Whether a chain of the model begins at a bone.
static bool begins_at(const struct document *document, int model, const char *from)
{
    for (int r = document_next_rig(document, RIG_CHAIN, 0); r >= 0;
         r = document_next_rig(document, RIG_CHAIN, r + 1)) {
        const struct chain *chain = &document->rigs[r].chain;
        if (document_find_model(document, chain->model, chain->by_file) == model && strcmp(chain->from, from) == 0)
            return true;
    }
    return false;
}

/// The names of both ends of the twin; false where it has none, or is there already.
static bool find_twin(const struct editor_world *world, int rig, char from[BONES_NAME], char to[BONES_NAME])
{
    const struct chain *chain = &world->document->rigs[rig].chain;
    const int model = document_find_model(world->document, chain->model, chain->by_file);
    const struct imported *shown = model >= 0 ? bones_character(world, model) : NULL;
    if (!shown || !other_side(chain->from, from) || !other_side(chain->to, to)) return false;
    return gltf_find_node(&shown->gltf, from) >= 0 && gltf_find_node(&shown->gltf, to) >= 0 &&
           !begins_at(world->document, model, from);
}

bool bones_twin(const struct editor_world *world, int chain, char from[BONES_NAME])
{
    char to[BONES_NAME];
    return find_twin(world, chain, from, to);
}

void bones_make_twin(struct core *core, const struct editor_world *world, int chain)
{
    char from[BONES_NAME], to[BONES_NAME], name[BONES_NAME], text[2 * BONES_NAME];
    if (!find_twin(world, chain, from, to)) return;
    struct rig twin = world->document->rigs[chain];
    struct edit edit = core_edit_of(EDIT_CHAIN_ADD, core->active);
    twin.name = twin.name && other_side(twin.name, name) ? name : NULL;
    twin.chain.from = from;
    twin.chain.to = to;
    twin.chain.mirror = !twin.chain.mirror;
    edit.contents = &twin;
    if (!core_step(core, world, "Mirror chain", 0, &edit)) return;
    snprintf(text, sizeof text, "Made the chain %s, mirrored, by the same splines.",
             rig_title(&world->document->rigs[world->document->rig_count - 1]));
    core_message(core, false, text);
}
