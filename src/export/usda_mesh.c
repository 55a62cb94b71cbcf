/// The meshes of an imported character in a .usda file, bound to its skeletons. Vertices are in the order of its .pc2.
#include "export/usda_look.h"
#include "export/usda_model.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Parts of a node's mesh, one after the other, that are a prim: all of them, unless some have a skin and some have not.
struct run {
    struct usda_model *model;
    int node;
    const struct gltf_part *parts;
    int count;
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

// --- arrays by vertex

/// Writes one vertex, after `before`.
typedef void write_vertex(const struct run *run, const struct gltf_part *part, int vertex, const char *before);

static void write_vertices(const struct run *run, const char *declaration, write_vertex *write)
{
    FILE *out = run->model->out;
    const char *before = "";
    fprintf(out, "            %s = [", declaration);
    for (int p = 0; p < run->count; p++) {
        for (int i = 0; i < run->parts[p].vertex_count; i++) {
            write(run, &run->parts[p], i, before);
            before = ", ";
        }
    }
    fputs("]", out);
}

static void write_vector(const struct run *run, const float v[3], const char *before)
{
    fprintf(run->model->out, "%s(%.9g, %.9g, %.9g)", before, (double)v[0], (double)v[1], (double)v[2]);
}

static void write_position(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    write_vector(run, part->position[vertex], before);
}

static void write_normal(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    write_vector(run, part->normal[vertex], before);
}

/// USD counts upwards.
static void write_uv(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    const float u = part->uv ? part->uv[vertex][0] : 0, v = part->uv ? part->uv[vertex][1] : 0;
    fprintf(run->model->out, "%s(%.9g, %.9g)", before, (double)u, 1 - (double)v);
}

/// The material's colour times the vertex's.
static void write_color(const struct run *run, const struct gltf_part *part, int vertex, const char *before)
{
    float color[3] = {1, 1, 1};
    for (int k = 0; k < 3; k++) {
        if (part->material >= 0) color[k] = run->model->gltf->materials[part->material].color[k];
        if (part->color) color[k] *= part->color[vertex][k];
    }
    write_vector(run, color, before);
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
    usda_by_vertex(run->model->out, each);
}

// --- faces and their materials

static void write_faces(const struct run *run)
{
    FILE *out = run->model->out;
    const char *before = "";
    uint32_t first = 0;
    fputs("            int[] faceVertexCounts = [", out);
    for (int p = 0; p < run->count; p++) {
        for (int i = 0; i + 2 < run->parts[p].index_count; i += 3) {
            fprintf(out, "%s3", before);
            before = ", ";
        }
    }
    before = "";
    fputs("]\n            int[] faceVertexIndices = [", out);
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p];
        for (int i = 0; i < part->index_count; i++) {
            fprintf(out, "%s%u", before, first + part->indices[i]);
            before = ", ";
        }
        first += (uint32_t)part->vertex_count;
    }
    fputs("]\n            uniform token subdivisionScheme = \"none\"\n", out);
}

static void write_subsets(const struct run *run)
{
    FILE *out = run->model->out;
    int face = 0;
    fputs("            uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n", out);
    for (int p = 0; p < run->count; p++) {
        const int count = run->parts[p].index_count / 3, material = run->parts[p].material;
        usda_begin_subset(out, p + 1);
        for (int i = 0; i < count; i++) fprintf(out, "%s%d", i > 0 ? ", " : "", face + i);
        usda_end_subset(out, run->model->name, material >= 0 ? run->model->materials[material] : NULL);
        face += count;
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
        for (int i = 0; i < run->parts[p].vertex_count; i++) {
            write_vector(run, by ? by[i] : still, before);
            before = ", ";
        }
    }
    fputs("]\n", out);
}

static void write_shapes(const struct run *run)
{
    const struct usda_model *model = run->model;
    const struct gltf_node *node = &model->gltf->nodes[run->node];
    const char(*names)[FORM_NAME] = model->shapes + node->first_weight;
    const int count = model->gltf->meshes[node->mesh].target_count;
    if (count == 0) return;
    fputs("            uniform token[] skel:blendShapes = [", model->out);
    for (int t = 0; t < count; t++) fprintf(model->out, "%s\"%s\"", t > 0 ? ", " : "", names[t]);
    fputs("]\n            rel skel:blendShapeTargets = [", model->out);
    for (int t = 0; t < count; t++)
        fprintf(model->out, "%s</scene/%s/%s/%s>", t > 0 ? ", " : "", model->name, run->name, names[t]);
    fputs("]\n", model->out);
    for (int t = 0; t < count; t++) {
        fprintf(model->out, "\n            def BlendShape \"%s\"\n            {\n", names[t]);
        write_offsets(run, t, false);
        write_offsets(run, t, true);
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
        usda_bind(model, skeleton_of(run), joint, bind);
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
            model->prims[skeleton_of(run)]);
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
    fprintf(model->out, "\n        def Mesh \"%s\" (\n", run->name);
    fputs("            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n        {\n", model->out);
    if (double_sided) fputs("            uniform bool doubleSided = 1\n", model->out);
    write_vertices(run, "point3f[] points", write_position);
    fputc('\n', model->out);
    write_interpolated(run, "normal3f[] normals", write_normal, 0);
    write_interpolated(run, "color3f[] primvars:displayColor", write_color, 0);
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
            const bool skinned = has_skin(model, n, &mesh->parts[p]);
            for (end = p + 1; end < mesh->part_count && has_skin(model, n, &mesh->parts[end]) == skinned;) end++;
            struct run run = {.model = model, .node = n, .parts = mesh->parts + p, .count = end - p};
            run.influences = count_influences(&run);
            run.name = usda_prim(model, gltf->nodes[n].name);
            write_run(&run);
        }
    }
}
