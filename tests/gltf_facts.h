/// What a glTF file holds, as the row of a table.
#ifndef TESTS_GLTF_FACTS_H
#define TESTS_GLTF_FACTS_H

#include "facts.h"
#include "gltf_builder.h"

enum { FACTS_VERTICES = FACTS_NUMBERS / GLTF_INFLUENCES }; ///< the most of a row

/// Where the words look: at first at part 0 of mesh 0, its target 0, node 0, and the pose at rest.
struct gltf_view {
    const struct gltf *gltf;
    struct gltf_pose pose;
    int part, target, node, clip;
};

/// "part", "target", "node", "clip" and "at" (seconds of the clip) say where the next words look. Nothing that is not there has numbers.
static inline int gltf_numbers(void *view, const char *word, const double *given, double *out)
{
    static const struct gltf_part none;
    static float posed[3 * FACTS_VERTICES], turned[3 * FACTS_VERTICES];
    struct gltf_view *v = view;
    const struct gltf *g = v->gltf;
    const struct {
        const char *word;
        int *number;
    } places[] = {{"part", &v->part}, {"target", &v->target}, {"node", &v->node}, {"clip", &v->clip}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        if (strcmp(word, places[i].word) != 0) continue;
        *places[i].number = (int)given[0];
        return FACTS_LOOKED;
    }
    if (strcmp(word, "at") == 0) {
        gltf_pose_clip(g, v->clip, given[0], &v->pose);
        gltf_pose_world(g, &v->pose);
        return FACTS_LOOKED;
    }
    const struct gltf_part *p = g->mesh_count > 0 ? &g->meshes[0].parts[v->part] : &none;
    const struct gltf_node *node = &g->nodes[v->node];
    const struct gltf_place *place = &v->pose.place[v->node];
    const float *world = v->pose.world[v->node];
    const bool has_target = p->targets && v->target < g->meshes[0].target_count;
    const int n = p->vertex_count, count = gltf_vertex_count(g, v->node);
    assert_true(n <= FACTS_VERTICES && count <= FACTS_VERTICES && p->index_count <= FACTS_NUMBERS);
    gltf_pose_vertices(g, &v->pose, v->node, (float(*)[3])posed, (float(*)[3])turned);
    const struct {
        const char *word;
        const void *at;
        int count;
    } reals[] = {{"position", p->position, 3 * n},
                 {"normal", p->normal, 3 * n},
                 {"uv", p->uv, 2 * n},
                 {"color", p->color, 4 * n},
                 {"weights", p->weights, GLTF_INFLUENCES * n},
                 {"moves", has_target ? p->targets[v->target].position : NULL, 3 * n},
                 {"posed", posed, 3 * count}, // of the node, in the pose
                 {"turned", turned, 3 * count},
                 {"translation", place->translation, 3},
                 {"rotation", place->rotation, 4},
                 {"scale", place->scale, 3},
                 {"place", world + 12, 3},
                 {"morphs", v->pose.weights, g->weight_count},
                 {"lo", g->lo, 3},
                 {"hi", g->hi, 3}};
    const struct {
        const char *word;
        int number;
    } wholes[] = {{"parts", g->mesh_count ? g->meshes[0].part_count : 0},
                  {"targets", g->mesh_count ? g->meshes[0].target_count : 0},
                  {"parent", node->parent},
                  {"mesh", node->mesh},
                  {"last", g->clip_count ? (int)g->clips[0].last : -1},
                  {"sheared", node->has_matrix}};
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++)
        if (strcmp(word, wholes[i].word) == 0) return take_whole(wholes[i].number, out);
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++)
        if (strcmp(word, reals[i].word) == 0) return take_floats(reals[i].at, reals[i].count, out);
    for (int i = 0; i < 9; i++) out[i] = (double)world[i / 3 * 4 + i % 3];
    if (strcmp(word, "axes") == 0) return 9;
    for (int i = 0; p->joints && i < GLTF_INFLUENCES * n; i++)
        out[i] = p->joints[i / GLTF_INFLUENCES][i % GLTF_INFLUENCES];
    if (strcmp(word, "joints") == 0) return p->joints ? GLTF_INFLUENCES * n : 0;
    for (int i = 0; i < p->index_count; i++) out[i] = p->indices[i];
    return strcmp(word, "indices") == 0 ? p->index_count : -1;
}

static inline void assert_facts(const struct gltf *gltf, const char *facts)
{
    struct gltf_view v = {.gltf = gltf, .clip = -1};
    assert_true(gltf_pose_create(gltf, &v.pose));
    assert_facts_of(&v, gltf_numbers, facts, facts);
    gltf_pose_free(&v.pose);
}

/// A file and what it holds; behind a |, the names of what it has that is not shown.
struct gltf_row {
    const char *members, *facts;
};

static inline void assert_rows(struct builder *b, const struct gltf_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *bar = strchr(rows[i].facts, '|'), *hidden = bar ? bar + 2 : "";
        read_built(b, rows[i].members);
        if (strcmp(b->gltf.not_shown ? b->gltf.not_shown : "", hidden) != 0)
            fail_msg("%s: \"%s\" is not shown", rows[i].facts, b->gltf.not_shown);
        assert_facts(&b->gltf, rows[i].facts);
        gltf_free(&b->gltf);
    }
}

#endif
