/// What a glTF file holds, as the row of a table: words, and the numbers that each of them must have, ~ for within 1e-6.
#ifndef TESTS_GLTF_FACTS_H
#define TESTS_GLTF_FACTS_H

#include "gltf_builder.h"

enum { FACTS_VERTICES = 32, FACTS_NUMBERS = GLTF_INFLUENCES * FACTS_VERTICES }; ///< the most of a row

/// Where the words look: at first at part 0 of mesh 0, its target 0, node 0, and the pose at rest.
struct gltf_view {
    const struct gltf *gltf;
    struct gltf_pose pose;
    int part, target, node, clip;
};

/// The numbers of a word; −1: there is no such word. Nothing that is not there has numbers.
static inline int numbers_of(const struct gltf_view *v, const char *word, double *out)
{
    static const struct gltf_part none;
    static float posed[3 * FACTS_VERTICES], turned[3 * FACTS_VERTICES];
    const struct gltf *g = v->gltf;
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
    for (size_t i = 0; i < sizeof wholes / sizeof *wholes; i++) {
        out[0] = wholes[i].number;
        if (strcmp(word, wholes[i].word) == 0) return 1;
    }
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++) {
        if (strcmp(word, reals[i].word) != 0) continue;
        for (int k = 0; reals[i].at && k < reals[i].count; k++) out[k] = (double)((const float *)reals[i].at)[k];
        return reals[i].at ? reals[i].count : 0;
    }
    for (int i = 0; i < 9; i++) out[i] = (double)world[i / 3 * 4 + i % 3];
    if (strcmp(word, "axes") == 0) return 9;
    for (int i = 0; p->joints && i < GLTF_INFLUENCES * n; i++)
        out[i] = p->joints[i / GLTF_INFLUENCES][i % GLTF_INFLUENCES];
    if (strcmp(word, "joints") == 0) return p->joints ? GLTF_INFLUENCES * n : 0;
    for (int i = 0; i < p->index_count; i++) out[i] = p->indices[i];
    return strcmp(word, "indices") == 0 ? p->index_count : -1;
}

/// Each word of `facts` has the numbers behind it. "part", "target", "node", "clip" and "at" (seconds of the clip) say where the next ones
/// look.
static inline void assert_facts(const struct gltf *gltf, const char *facts)
{
    struct gltf_view v = {.gltf = gltf, .clip = -1};
    assert_true(gltf_pose_create(gltf, &v.pose));
    for (const char *at = facts; *at;) {
        double numbers[FACTS_NUMBERS], actual[FACTS_NUMBERS], within[FACTS_NUMBERS];
        char word[16];
        int count = 0, used;
        assert_int_equal(sscanf(at, " %15[a-z] %n", word, &used), 1);
        for (at += used; strchr("~-.0123456789", *at) && *at; count++) {
            char *end;
            assert_true(count < FACTS_NUMBERS);
            within[count] = *at == '~' ? 1e-6 : 0;
            numbers[count] = (double)strtof(at + (*at == '~'), &end);
            at = end + strspn(end, " ");
        }
        struct {
            const char *word;
            int *number;
        } places[] = {{"part", &v.part}, {"target", &v.target}, {"node", &v.node}, {"clip", &v.clip}};
        bool looks = strcmp(word, "at") == 0;
        if (looks) gltf_pose_clip(gltf, v.clip, numbers[0], &v.pose);
        if (looks) gltf_pose_world(gltf, &v.pose);
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            if (strcmp(word, places[i].word) != 0) continue;
            *places[i].number = (int)numbers[0];
            looks = true;
        }
        if (looks) continue;
        const int found = numbers_of(&v, word, actual);
        if (found != count) fail_msg("%s: %d numbers of \"%s\", expected %d", facts, found, word, count);
        for (int i = 0; i < count; i++) {
            if (!(fabs(actual[i] - numbers[i]) <= within[i]))
                fail_msg("%s: number %d of \"%s\" is %.9g, expected %.9g", facts, i, word, actual[i], numbers[i]);
        }
    }
    gltf_pose_free(&v.pose);
}

/// A file, what it holds, and the names of what it has that is not shown; NULL: all is.
struct gltf_row {
    const char *members, *facts, *not_shown;
};

static inline void assert_rows(struct builder *b, const struct gltf_row *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        read_built(b, rows[i].members);
        if (strcmp(b->gltf.not_shown ? b->gltf.not_shown : "", rows[i].not_shown ? rows[i].not_shown : "") != 0)
            fail_msg("%s: \"%s\" is not shown", rows[i].facts, b->gltf.not_shown);
        assert_facts(&b->gltf, rows[i].facts);
        gltf_free(&b->gltf);
    }
}

#endif
