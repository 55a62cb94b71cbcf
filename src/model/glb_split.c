/// Splits vertices at the seams of texture coordinates.
#include "model/glb_split.h"
#include <stdlib.h>
#include <string.h>

/// Vertices of the file by the character's: the first is its own number, `next` the next copy, 0 the end.
struct chains {
    uint32_t *uv, *next;
};

static uint32_t find_or_add(struct split *s, struct chains *chains, uint32_t vertex, uint32_t uv)
{
    uint32_t at = vertex;
    if (chains->uv[at] == LOOKS_NONE) chains->uv[at] = uv;
    while (chains->uv[at] != uv && chains->next[at]) at = chains->next[at];
    if (chains->uv[at] == uv) return at;
    chains->next[at] = (uint32_t)s->count;
    at = (uint32_t)s->count++;
    s->source[at] = vertex;
    chains->uv[at] = uv;
    chains->next[at] = 0;
    return at;
}

static void split_vertices(struct split *s, const struct character *c, struct chains *chains)
{
    const struct looks *looks = &c->looks;
    s->count = c->vertex_count;
    for (int v = 0; v < c->vertex_count; v++) {
        s->source[v] = (uint32_t)v;
        chains->uv[v] = LOOKS_NONE;
        chains->next[v] = 0;
    }
    for (int i = 0; i < c->index_count; i++) {
        const uint32_t uv = looks->corner ? looks->corner[i] : LOOKS_NONE;
        s->indices[i] = uv == LOOKS_NONE ? c->indices[i] : find_or_add(s, chains, c->indices[i], uv);
    }
    for (int v = 0; s->uv && v < s->count; v++) {
        const uint32_t uv = looks->corner ? chains->uv[v] : (uint32_t)v;
        memcpy(s->uv[v], uv != LOOKS_NONE ? looks->uv[uv] : (float[2]){0}, sizeof *s->uv);
    }
}

bool split_create(struct split *split, const struct character *c)
{
    const size_t most = (size_t)c->vertex_count + (c->looks.corner ? (size_t)c->index_count : 0) + 1;
    struct chains chains = {.uv = malloc(most * sizeof *chains.uv), .next = malloc(most * sizeof *chains.next)};
    *split = (struct split){.source = malloc(most * sizeof *split->source),
                            .indices = malloc(((size_t)c->index_count + 1) * sizeof *split->indices),
                            .uv = c->looks.uv ? malloc(most * sizeof *split->uv) : NULL};
    const bool good = chains.uv && chains.next && split->source && split->indices && (split->uv || !c->looks.uv);
    if (good) {
        split_vertices(split, c, &chains);
    } else {
        split_free(split);
    }
    free(chains.uv);
    free(chains.next);
    return good;
}

void split_free(struct split *split)
{
    free(split->source);
    free(split->indices);
    free(split->uv);
    *split = (struct split){0};
}
