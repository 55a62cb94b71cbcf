/// The meshes of a rig in a .usda file, bound to its skeletons. Vertices are in the order of its .pc2.
#include "base/need.h"
#include "export/usda.h"
#include <stdlib.h>

/// Parts of a node's mesh, one after the other, that are a prim: all of them, unless some have a skin or normals and some have not.
struct run {
    struct usda_model *model;
    int node;
    const struct gltf_part *parts;
    int count;
    int owner; ///< the first part whose vertices others share, which leave theirs out; −1: none, as in an imported character's .pc2
    int influences; ///< joints a vertex; 0: all hangs at the node's own
    const char *name;
};

static bool has_skin(const struct usda_model *model, int node, const struct gltf_part *part)
{
    return model->gltf->nodes[node].skin >= 0 && part->joints;
}

static int skeleton_of(const struct run *run)
{
    const int skin = run->model->gltf->nodes[run->node].skin;
    return skin >= 0 ? skin : 0;
}

/// Whether a part's vertices are written with another's: where texture coordinates differ they are not.
static bool is_left_out(const struct run *run, int p)
{
    const struct gltf_part *part = &run->parts[p];
    const struct gltf_part *owner = run->owner >= 0 && p != run->owner ? &run->parts[run->owner] : NULL;
    return owner && part->position == owner->position && part->uv == owner->uv;
}

/// The vertex of the prim that a part's first one is; `next` counts them.
static int first_vertex(const struct run *run, int p, int *owner, int *next)
{
    if (is_left_out(run, p)) return *owner;
    const int first = *next;
    if (p == run->owner) *owner = first;
    *next += run->parts[p].vertex_count;
    return first;
}

// --- arrays by vertex

/// Writes one vertex, after `before`.
typedef void write_vertex(const struct run *run, const struct gltf_part *part, int vertex, const char *before);

static void write_vertices(const struct run *run, const char *declaration, write_vertex *write)
{
    FILE *out = run->model->out;
    const char *before = "";
    fprintf(out, "            %s = [", declaration);
    for (int p = 0; p < run->count; p++) {
        for (int i = 0; i < run->parts[p].vertex_count && !is_left_out(run, p); i++) {
            write(run, &run->parts[p], i, before);
            before = ", ";
        }
    }
    fputs("]", out);
}

/// Marks an array as one per vertex, with `each` elements for each; 0: one.
static void end_by_vertex(FILE *out, int each)
{
    fputs(" (\n", out);
    if (each > 0) fprintf(out, "                elementSize = %d\n", each);
    fputs("                interpolation = \"vertex\"\n            )\n", out);
}

static void write_position(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    usda_vector(run->model->out, before, part->position[vertex]);
}

static void write_normal(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    usda_vector(run->model->out, before, part->normal[vertex]);
}

/// USD counts upwards.
static void write_uv(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    const float u = part->uv ? part->uv[vertex][0] : 0, v = part->uv ? part->uv[vertex][1] : 0;
    fprintf(run->model->out, "%s(%.9g, %.9g)", before, (double)u, 1 - (double)v);
}

static void write_slots(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    const struct usda_model *model = run->model;
    const struct gltf_skin *skin = &model->gltf->skins[skeleton_of(run)];
    for (int i = 0; i < run->influences; i++) {
        const int slot = part->weights[vertex][i] != 0 ? part->joints[vertex][i] : 0;
        fprintf(model->out, "%s%d", i > 0 ? ", " : before, model->joint_of[skin->joints[slot]]);
    }
}

static void write_weights(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    for (int i = 0; i < run->influences; i++)
        fprintf(run->model->out, "%s%.9g", i > 0 ? ", " : before, (double)part->weights[vertex][i]);
}

static void write_interpolated(const struct run *run, const char *declaration, write_vertex *write, int each)
{
    write_vertices(run, declaration, write);
    end_by_vertex(run->model->out, each);
}

/// The material's colour times the vertex's: where two materials meet, that of the later triangle.
static void write_colors(const struct run *run)
{
    int count = 0, owner = 0, next = 0;
    for (int p = 0; p < run->count; p++) first_vertex(run, p, &owner, &count);
    float(*tint)[3] = need(((size_t)count + 1), sizeof *tint);
    for (int i = 0; i < 3 * count; i++) tint[i / 3][i % 3] = 1;
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p];
        const int first = first_vertex(run, p, &owner, &next);
        for (int i = 0; i < part->index_count; i++) {
            const uint32_t v = part->indices[i];
            for (int k = 0; k < 3; k++)
                tint[first + (int)v][k] =
                    (part->color ? part->color[v][k] : 1) *
                    (part->material >= 0 ? run->model->gltf->materials[part->material].color[k] : 1);
        }
    }
    fputs("            color3f[] primvars:displayColor = [", run->model->out);
    for (int i = 0; i < count; i++) usda_vector(run->model->out, i > 0 ? ", " : "", tint[i]);
    fputs("]", run->model->out);
    end_by_vertex(run->model->out, 0);
    free(tint);
}

// --- faces and their materials

/// The index behind the polygon that begins at index `i`.
static int polygon_end(const struct gltf_part *part, int i)
{
    for (i += 3; i < part->index_count && gltf_joins(part, i);) i += 3;
    return i;
}

static void write_faces(const struct run *run)
{
    FILE *out = run->model->out;
    const char *before = "";
    int owner = 0, next = 0;
    fputs("            int[] faceVertexCounts = [", out);
    for (int p = 0; p < run->count; p++) {
        for (int i = 0, end; i < run->parts[p].index_count; i = end, before = ", ") {
            end = polygon_end(&run->parts[p], i);
            fprintf(out, "%s%d", before, (end - i) / 3 + 2);
        }
    }
    before = "";
    fputs("]\n            int[] faceVertexIndices = [", out);
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p];
        const uint32_t first = (uint32_t)first_vertex(run, p, &owner, &next);
        for (int i = 0; i < part->index_count; i++) {
            if (i % 3 < 2 && gltf_joins(part, i - i % 3)) continue;
            fprintf(out, "%s%u", before, first + part->indices[i]);
            before = ", ";
        }
    }
    fputs("]\n            uniform token subdivisionScheme = \"none\"\n", out);
}

static void write_subsets(const struct run *run)
{
    FILE *out = run->model->out;
    int face = 0;
    fputs("            uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n", out);
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p];
        fprintf(out, "\n            def GeomSubset \"part_%d\" (\n", p + 1);
        fputs("                prepend apiSchemas = [\"MaterialBindingAPI\"]\n            )\n            {\n", out);
        fputs("                uniform token elementType = \"face\"\n", out);
        fputs("                uniform token familyName = \"materialBind\"\n                int[] indices = [", out);
        for (int i = 0; i < part->index_count; i = polygon_end(part, i))
            fprintf(out, "%s%d", i > 0 ? ", " : "", face++);
        fputs("]\n", out);
        if (part->material >= 0)
            fprintf(out, "                rel material:binding = </scene/%s/materials/%s>\n", run->model->name,
                    run->model->materials[part->material]);
        fputs("            }\n", out);
    }
}

// --- blend shapes

/// How far a target takes the vertices, or turns the normals, of all parts.
static void write_offsets(const struct run *run, int target, bool normals)
{
    static const float still[3] = {0};
    FILE *out = run->model->out;
    const char *before = "";
    fprintf(out, "                uniform vector3f[] %s = [", normals ? "normalOffsets" : "offsets");
    for (int p = 0; p < run->count; p++) {
        const struct gltf_target *of = &run->parts[p].targets[target];
        const float(*by)[3] = normals ? of->normal : of->position;
        for (int i = 0; i < run->parts[p].vertex_count && !is_left_out(run, p); i++) {
            usda_vector(out, before, by ? by[i] : still);
            before = ", ";
        }
    }
    fputs("]\n", out);
}

static void write_shapes(const struct run *run)
{
    const struct usda_model *model = run->model;
    const struct gltf_node *node = &model->gltf->nodes[run->node];
    const struct usda_shape *shapes = model->shapes + node->first_weight;
    const int count = model->gltf->meshes[node->mesh].target_count;
    if (count == 0) return;
    fputs("            uniform token[] skel:blendShapes = [", model->out);
    for (int t = 0; t < count; t++) {
        if (t > 0) fputs(", ", model->out);
        usda_string(model->out, shapes[t].token);
    }
    fputs("]\n            rel skel:blendShapeTargets = [", model->out);
    for (int t = 0; t < count; t++)
        fprintf(model->out, "%s</scene/%s/%s/%s>", t > 0 ? ", " : "", model->name, run->name, shapes[t].prim);
    fputs("]\n", model->out);
    for (int t = 0; t < count; t++) {
        fputc('\n', model->out);
        const char *title = gltf_target_name(&model->gltf->meshes[node->mesh], t);
        usda_begin(model->out, 12, "BlendShape", shapes[t].prim, title ? title : shapes[t].token, NULL);
        write_offsets(run, t, false);
        if (run->parts->normal) write_offsets(run, t, true);
        fputs("            }\n", model->out);
    }
}

// --- all of a mesh

static void write_binding(const struct run *run)
{
    const struct usda_model *model = run->model;
    const int joint = model->joint_of[run->node];
    if (run->influences > 0) {
        write_interpolated(run, "int[] primvars:skel:jointIndices", write_slots, run->influences);
        write_interpolated(run, "float[] primvars:skel:jointWeights", write_weights, run->influences);
    } else {
        double bind[16];
        usda_bind(run->model, skeleton_of(run), joint, bind);
        fprintf(model->out,
                "            int[] primvars:skel:jointIndices = [%d] (\n                elementSize = 1\n", joint);
        fputs("                interpolation = \"constant\"\n            )\n", model->out);
        fputs("            float[] primvars:skel:jointWeights = [1] (\n                elementSize = 1\n",
              model->out);
        fputs("                interpolation = \"constant\"\n            )\n", model->out);
        fputs("            matrix4d primvars:skel:geomBindTransform = ", model->out);
        usda_matrix(model->out, bind);
        fputc('\n', model->out);
    }
    fprintf(model->out, "            rel skel:skeleton = </scene/%s/%s>\n", model->name,
            model->skeletons[skeleton_of(run)]);
}

static void write_run(const struct run *run)
{
    const struct usda_model *model = run->model;
    bool double_sided = false, has_uv = false;
    for (int p = 0; p < run->count; p++) {
        const int material = run->parts[p].material;
        double_sided = double_sided || (material >= 0 && model->gltf->materials[material].double_sided);
        has_uv = has_uv || run->parts[p].uv;
    }
    fputc('\n', model->out);
    usda_begin(model->out, 8, "Mesh", run->name, model->gltf->nodes[run->node].name, "SkelBindingAPI");
    if (double_sided) fputs("            uniform bool doubleSided = 1\n", model->out);
    write_vertices(run, "point3f[] points", write_position);
    fputc('\n', model->out);
    if (run->parts->normal) write_interpolated(run, "normal3f[] normals", write_normal, 0);
    write_colors(run);
    if (has_uv) write_interpolated(run, "texCoord2f[] primvars:st", write_uv, 0);
    write_faces(run);
    write_binding(run);
    write_shapes(run);
    write_subsets(run);
    fputs("        }\n", model->out);
}

/// The joints that a vertex has at most; where a part has no skin, all of the run's have none.
static int count_influences(const struct run *run)
{
    int most = 0;
    if (!has_skin(run->model, run->node, run->parts)) return 0;
    for (int p = 0; p < run->count; p++) {
        for (int i = 0; i < run->parts[p].vertex_count; i++) {
            for (int k = most; k < GLTF_INFLUENCES; k++) {
                if (run->parts[p].weights[i][k] != 0) most = k + 1;
            }
        }
    }
    return most > 0 ? most : 1;
}

void usda_write_meshes(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    for (int n = 0; n < gltf->node_count; n++) {
        const struct gltf_mesh *mesh = gltf->nodes[n].mesh >= 0 ? &gltf->meshes[gltf->nodes[n].mesh] : NULL;
        for (int p = 0, end; mesh && p < mesh->part_count; p = end) {
            struct run run = {.model = model, .node = n, .parts = mesh->parts + p, .owner = -1};
            const bool skinned = has_skin(model, n, run.parts), is_flat = !run.parts->normal;
            for (end = p; end < mesh->part_count && has_skin(model, n, &mesh->parts[end]) == skinned &&
                          !mesh->parts[end].normal == is_flat;
                 end++) {
                if (model->is_own && run.owner < 0 && mesh->parts[end].position == mesh->parts->position)
                    run.owner = end - p;
            }
            run.count = end - p;
            run.influences = count_influences(&run);
            run.name = usda_name(&model->prims, gltf->nodes[n].name, false);
            write_run(&run);
        }
    }
}
