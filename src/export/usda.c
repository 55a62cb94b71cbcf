/// Rigs as a USD scene in text: UsdSkel skeletons, blend shapes, a time sample a key. Metres, y up; time codes are the document's frames.
///
/// Of a character it is its own model, of any other rig the one that its glTF file would hold. Every node that something shown hangs at
/// is a joint, and each skin a skeleton of these, with a bind pose of its own. Textures are files in a folder beside it.
#include "base/file.h"
#include "base/need.h"
#include "export/form.h"
#include "model/gltf.h"
#include "model/vector.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// A node is one joint; or two, if its scale is constant and no half-precision number, as UsdSkel's scales are: one that moves, and
/// below it one that scales.
enum usda_joint_part { JOINT_WHOLE, JOINT_UNSCALED, JOINT_SCALE };

struct usda_joint {
    int node, parent; ///< `parent`: of the joints, −1: none
    enum usda_joint_part part;
    bool moves;               ///< else it has no keys: it rests
    const char *name, *title; ///< `title`: the node's, which the name may not be
    double world[16];         ///< at rest in the character's space; columns first, as all matrices
};

struct usda_model {
    struct pool pool;
    struct export_range *range;
    int rig;
    const char *name; ///< of its prim
    FILE *out;
    const struct gltf *gltf;
    bool is_own;               ///< not a character: the only clip of its model has its keys
    struct gltf_place *places; ///< [key · nodes + node], rotations the short way
    float *weights;            ///< [key · weights + weight]
    struct usda_shape {
        const char *token, *prim; ///< its name in arrays, and that of its prim
    } * shapes;                   ///< of each weight
    struct usda_joint *joints;    ///< parents before their children
    int joint_count;
    bool moves;             ///< any of them
    int *joint_of;          ///< of each node: the last of its joints; −1: none
    const char **materials; ///< their prims
    const char **skeletons;
    struct names prims, joint_names, shape_tokens, shape_prims, material_prims;
};

// --- text
/// Letters outside ASCII that USD's names may have (Unicode's XID_Start, and XID_Continue): the scripts in common use.
static const struct {
    uint32_t first, last;
    bool only_inside; ///< not as the first letter
} letters[] = {{0xC0, 0xD6, false},     {0xD8, 0xF6, false},      {0xF8, 0x2C1, false},    {0x300, 0x36F, true},
               {0x370, 0x373, false},   {0x388, 0x38A, false},    {0x38E, 0x3A1, false},   {0x3A3, 0x3F5, false},
               {0x3F7, 0x481, false},   {0x48A, 0x52F, false},    {0x531, 0x556, false},   {0x560, 0x588, false},
               {0x591, 0x5BD, true},    {0x5D0, 0x5EA, false},    {0x620, 0x64A, false},   {0x64B, 0x669, true},
               {0x66E, 0x66F, false},   {0x671, 0x6D3, false},    {0x6F0, 0x6F9, true},    {0x900, 0x903, true},
               {0x904, 0x939, false},   {0x93A, 0x94F, true},     {0x958, 0x961, false},   {0x966, 0x96F, true},
               {0x985, 0x98C, false},   {0x993, 0x9A8, false},    {0x9BE, 0x9C4, true},    {0xE01, 0xE30, false},
               {0xE31, 0xE3A, true},    {0xE40, 0xE46, false},    {0xE47, 0xE4E, true},    {0xE50, 0xE59, true},
               {0x10D0, 0x10FA, false}, {0x1100, 0x1248, false},  {0x1E00, 0x1F15, false}, {0x3005, 0x3007, false},
               {0x3041, 0x3096, false}, {0x3099, 0x309A, true},   {0x30A1, 0x30FA, false}, {0x30FC, 0x30FF, false},
               {0x3105, 0x312F, false}, {0x3400, 0x4DBF, false},  {0x4E00, 0xA48C, false}, {0xAC00, 0xD7A3, false},
               {0xF900, 0xFA6D, false}, {0xFF10, 0xFF19, true},   {0xFF21, 0xFF3A, false}, {0xFF41, 0xFF5A, false},
               {0xFF66, 0xFF9D, false}, {0x20000, 0x2A6DF, false}};

static bool is_letter(uint32_t c, bool is_first)
{
    if (c < 0x80) return isalpha((int)c) || (!is_first && isdigit((int)c));
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        if (c >= letters[i].first && c <= letters[i].last) return !(is_first && letters[i].only_inside);
    }
    return false;
}

/// An empty set of names of prims, or of joints: as long as Blender keeps them.
static const struct names no_names = {.between = "_", .most = 63};

/// Takes a name of letters, digits and "_": "up.-re" → "up_minus_re". All are ASCII, because older readers take no other names of prims;
/// of joints, which are paths in strings, they may be of any script.
static const char *usda_name(struct names *names, const char *wanted, bool any_script)
{
    char *const identifier = need(6 * strlen(wanted) + 2, 1), *to = identifier;
    for (const char *from = wanted; *from;) {
        const char *letter = from;
        const uint32_t c = utf8_next(&from);
        const bool fits = c < 0x80 || any_script;
        if (letter == wanted && !(fits && is_letter(c, true))) *to++ = '_';
        if (fits && is_letter(c, false)) {
            to = mempcpy(to, letter, (size_t)(from - letter));
        } else if (c == '-' && (letter == wanted || letter[-1] == '.')) {
            to = stpcpy(to, "minus_");
        } else {
            *to++ = '_';
        }
    }
    strcpy(to, wanted[0] ? "" : "_");
    const char *name = names_add(names, identifier);
    free(identifier);
    return name;
}

/// A string in quotes.
static void usda_string(FILE *out, const char *text)
{
    fputc('"', out);
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\') fputc('\\', out);
        fprintf(out, (unsigned char)*c < ' ' ? "\\x%02x" : "%c", (unsigned char)*c);
    }
    fputc('"', out);
}

/// Begins a prim, up to its first brace. `title` is what people read where it differs from its name. `api`: what its schemas are; NULL: none.
static void usda_begin(FILE *out, int indent, const char *type, const char *name, const char *title, const char *api)
{
    const bool is_titled = strcmp(name, title) != 0;
    fprintf(out, "%*sdef %s \"%s\"%s\n", indent, "", type, name, is_titled || api ? " (" : "");
    if (is_titled) {
        fprintf(out, "%*sdisplayName = ", indent + 4, "");
        usda_string(out, title);
        fputc('\n', out);
    }
    if (api) fprintf(out, "%*sprepend apiSchemas = [\"%s\"]\n", indent + 4, "", api);
    if (is_titled || api) fprintf(out, "%*s)\n", indent, "");
    fprintf(out, "%*s{\n", indent, "");
}

/// "before(x, y, z)"
static void usda_vector(FILE *out, const char *before, const float *v)
{
    fprintf(out, "%s(%.9g, %.9g, %.9g)", before, (double)v[0], (double)v[1], (double)v[2]);
}

/// "((…), …)": rows of vectors, which USD multiplies from the left.
static void usda_matrix(FILE *out, const double m[16])
{
    for (int c = 0; c < 4; c++) {
        fprintf(out, "%s(%.17g, %.17g, %.17g, %.17g)", c > 0 ? ", " : "(", m[4 * c], m[4 * c + 1], m[4 * c + 2],
                m[4 * c + 3]);
    }
    fputs(")", out);
}

// --- the joints: which there are, and where they rest

/// Where a node is at a key, against its parent.
static const struct gltf_place *place_at(const struct usda_model *model, int key, int node)
{
    return &model->places[(size_t)key * (size_t)model->gltf->node_count + (size_t)node];
}

/// Whether half precision, with 11 bits, has the number.
static bool is_half(float number)
{
    int exponent;
    const float mantissa = 2048 * frexpf(number, &exponent);
    return number == 0 || (exponent > -13 && exponent <= 16 && fabsf(mantissa - roundf(mantissa)) < 1e-3f);
}

static bool moves(const struct usda_model *model, int node)
{
    for (int k = 0; k < model->range->key_count; k++) {
        if (memcmp(place_at(model, k, node), &model->gltf->nodes[node].place, sizeof *model->places) != 0)
            return !model->gltf->nodes[node].has_matrix;
    }
    return false;
}

/// Of a joint against its parent, at rest.
static void rest_of(const struct usda_model *model, int number, double m[16])
{
    const struct usda_joint *joint = &model->joints[number];
    struct gltf_node node = model->gltf->nodes[joint->node];
    if (joint->part == JOINT_UNSCALED) {
        for (int k = 0; k < 3; k++) node.place.scale[k] = 1;
    } else if (joint->part == JOINT_SCALE) {
        node.place = (struct gltf_place){.rotation = {0, 0, 0, 1}};
        memcpy(node.place.scale, place_at(model, 0, joint->node)->scale, sizeof node.place.scale);
    }

    // In double precision, columns first.
    const struct gltf_place *place = &node.place;
    double q[4], turned[9];
    for (int k = 0; k < 4; k++) q[k] = (double)place->rotation[k];
    quat_matrix(q, turned);
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) m[4 * c + r] = (double)place->scale[c] * turned[3 * c + r];
        m[4 * c + 3] = 0;
        m[12 + c] = (double)place->translation[c];
    }
    m[15] = 1;
    for (int i = 0; i < 16 && node.has_matrix; i++) m[i] = (double)node.matrix[i];
}

static void add_joint(struct usda_model *model, int node, int parent, enum usda_joint_part part)
{
    const int j = model->joint_count++;
    struct usda_joint *joint = &model->joints[j];
    double local[16];
    *joint = (struct usda_joint){
        .node = node, .parent = parent, .part = part, .moves = part != JOINT_SCALE && moves(model, node)};
    model->moves |= joint->moves;
    joint->title = pool_text(&model->pool, model->gltf->nodes[node].name, part == JOINT_SCALE ? "_scale" : "", "");
    joint->name = usda_name(&model->joint_names, joint->title, true);
    rest_of(model, j, parent >= 0 ? local : joint->world);
    const double *above = parent >= 0 ? model->joints[parent].world : NULL;
    for (int i = 0; above && i < 16; i++) { // above · local
        joint->world[i] = 0;
        for (int k = 0; k < 4; k++) joint->world[i] += above[4 * k + i % 4] * local[i / 4 * 4 + k];
    }
    model->joint_of[node] = j;
}

static void make_joints(struct usda_model *model)
{
    const struct gltf *gltf = model->gltf;
    bool *needed = need_zeroed((size_t)gltf->node_count + 1, sizeof *needed);
    // What must be a joint: those of skins, what meshes, or some of them, hang at as a whole, and what is above them.
    for (int s = 0; s < gltf->skin_count; s++)
        for (int j = 0; j < gltf->skins[s].joint_count; j++) needed[gltf->skins[s].joints[j]] = true;
    for (int i = gltf->node_count - 1; i >= 0; i--) {
        const int n = gltf->order[i], parent = gltf->nodes[n].parent;
        const struct gltf_mesh *mesh = gltf->nodes[n].mesh >= 0 ? &gltf->meshes[gltf->nodes[n].mesh] : NULL;
        for (int p = 0; mesh && p < mesh->part_count; p++)
            needed[n] = needed[n] || gltf->nodes[n].skin < 0 || !mesh->parts[p].joints;
        if (parent >= 0 && needed[n]) needed[parent] = true;
    }

    for (int i = 0; i < gltf->node_count; i++) {
        const int n = gltf->order[i], above = gltf->nodes[n].parent;
        model->joint_of[n] = -1;
        if (!needed[n]) continue;
        const float *scale = place_at(model, 0, n)->scale;
        bool two = moves(model, n) && !(is_half(scale[0]) && is_half(scale[1]) && is_half(scale[2]));
        for (int k = 1; two && k < model->range->key_count; k++)
            two = memcmp(place_at(model, k, n)->scale, scale, 3 * sizeof *scale) == 0;
        add_joint(model, n, above >= 0 ? model->joint_of[above] : -1, two ? JOINT_UNSCALED : JOINT_WHOLE);
        if (two) add_joint(model, n, model->joint_of[n], JOINT_SCALE);
    }
    free(needed);
}

// --- where it was bound

/// Of a joint in the character's space as a skeleton was bound to it, or at rest where the skin has no such joint.
static void usda_bind(const struct usda_model *model, int skeleton, int joint, double matrix[16])
{
    const struct gltf_skin *skin = skeleton < model->gltf->skin_count ? &model->gltf->skins[skeleton] : NULL;
    const int node = model->joints[joint].node;
    int slot = 0;
    while (skin && slot < skin->joint_count && skin->joints[slot] != node) slot++;
    memcpy(matrix, model->joints[joint].world, sizeof model->joints[joint].world);
    if (!skin || slot == skin->joint_count || model->joint_of[node] != joint) return;

    // The inverse of an affine matrix, where it has one.
    const float *m = skin->inverse_bind[slot];
    double a[3][3], inverse[16], det = 0;
    for (int i = 0; i < 9; i++) a[i / 3][i % 3] = (double)m[i / 3 * 4 + i % 3];
    for (int c = 0; c < 3; c++) {
        const double *p = a[(c + 1) % 3], *q = a[(c + 2) % 3];
        for (int r = 0; r < 3; r++)
            inverse[4 * r + c] = p[(r + 1) % 3] * q[(r + 2) % 3] - p[(r + 2) % 3] * q[(r + 1) % 3];
    }
    for (int r = 0; r < 3; r++) det += a[0][r] * inverse[4 * r];
    if (!(fabs(det) > 1e-300)) return;
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) inverse[4 * c + r] /= det;
        inverse[4 * c + 3] = 0;
    }
    for (int r = 0; r < 3; r++)
        inverse[12 + r] =
            -(inverse[r] * (double)m[12] + inverse[4 + r] * (double)m[13] + inverse[8 + r] * (double)m[14]);
    inverse[15] = 1;
    memcpy(matrix, inverse, sizeof inverse);
}

// --- the skeletons

static void write_path(const struct usda_model *model, int joint)
{
    if (model->joints[joint].parent >= 0) {
        write_path(model, model->joints[joint].parent);
        fputc('/', model->out);
    }
    fputs(model->joints[joint].name, model->out);
}

static void write_joints(const struct usda_model *model, bool moving)
{
    const char *before = "";
    fputs("            uniform token[] joints = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (moving && !model->joints[j].moves) continue;
        fprintf(model->out, "%s\"", before);
        write_path(model, j);
        fputc('"', model->out);
        before = ", ";
    }
    fputs("]\n", model->out);
}

static bool is_animated(const struct usda_model *model) { return model->moves || model->gltf->weight_count > 0; }

static void write_skeleton(struct usda_model *model, int skeleton)
{
    double m[16];
    usda_begin(model->out, 8, "Skeleton", model->skeletons[skeleton], model->skeletons[skeleton], "SkelBindingAPI");
    write_joints(model, false);
    const char *before = "            uniform token[] jointNames = [";
    bool titled = false; // the names that the file has cannot be those of joints
    for (int j = 0; j < model->joint_count; j++) titled |= strcmp(model->joints[j].name, model->joints[j].title) != 0;
    for (int j = 0; titled && j < model->joint_count; j++, before = ", ") {
        fputs(before, model->out);
        usda_string(model->out, model->joints[j].title);
    }
    if (titled) fputs("]\n", model->out);
    fputs("            uniform matrix4d[] bindTransforms = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (j > 0) fputs(", ", model->out);
        usda_bind(model, skeleton, j, m);
        usda_matrix(model->out, m);
    }
    fputs("]\n            uniform matrix4d[] restTransforms = [", model->out);
    for (int j = 0; j < model->joint_count; j++) {
        if (j > 0) fputs(", ", model->out);
        rest_of(model, j, m);
        usda_matrix(model->out, m);
    }
    fputs("]\n", model->out);
    if (is_animated(model))
        fprintf(model->out, "            rel skel:animationSource = </scene/%s/animation>\n", model->name);
    fputs("        }\n\n", model->out);
}

// --- what moves them

enum usda_samples { TRANSLATIONS, ROTATIONS, SCALES, WEIGHTS };

static const float *numbers_of(const struct gltf_place *place, enum usda_samples samples)
{
    return samples == TRANSLATIONS ? place->translation : samples == ROTATIONS ? place->rotation : place->scale;
}

/// A key for all joints that move, or for the weights; of places that never change one.
static void write_samples(const struct usda_model *model, const char *declaration, enum usda_samples samples)
{
    static const float one[3] = {1, 1, 1};
    const size_t size = (samples == ROTATIONS ? 4 : 3) * sizeof *one;
    const int weights = model->gltf->weight_count, nodes = model->gltf->node_count, keys = model->range->key_count;
    bool changes = samples == WEIGHTS;
    for (int k = 1; k < keys && !changes; k++) {
        for (int n = 0; n < nodes && !changes; n++)
            changes = memcmp(numbers_of(place_at(model, 0, n), samples), numbers_of(place_at(model, k, n), samples),
                             size) != 0;
    }
    fprintf(model->out, "            %s.timeSamples = {\n", declaration);
    for (int k = 0; k < (changes ? keys : 1); k++) {
        const char *before = "[";
        fprintf(model->out, "                %.9g: ", range_frame(model->range, k));
        for (int j = 0; samples != WEIGHTS && j < model->joint_count; j++) {
            const struct usda_joint *joint = &model->joints[j];
            const float *v = numbers_of(place_at(model, k, joint->node), samples);
            if (!joint->moves) continue;
            if (samples == ROTATIONS)
                fprintf(model->out, "%s(%.9g, %.9g, %.9g, %.9g)", before, (double)v[3], (double)v[0], (double)v[1],
                        (double)v[2]);
            else
                usda_vector(model->out, before, samples == SCALES && joint->part == JOINT_UNSCALED ? one : v);
            before = ", ";
        }
        for (int i = 0; samples == WEIGHTS && i < weights; i++)
            fprintf(model->out, "%s%.9g", i > 0 ? ", " : "[",
                    (double)model->weights[(size_t)k * (size_t)weights + (size_t)i]);
        fputs("],\n", model->out);
    }
    fputs("            }\n", model->out);
}

static void write_animation(const struct usda_model *model)
{
    fputs("        def SkelAnimation \"animation\"\n        {\n", model->out);
    if (model->moves) {
        write_joints(model, true);
        write_samples(model, "float3[] translations", TRANSLATIONS);
        write_samples(model, "quatf[] rotations", ROTATIONS);
        write_samples(model, "half3[] scales", SCALES);
    }
    if (model->gltf->weight_count > 0) {
        fputs("            uniform token[] blendShapes = [", model->out);
        for (int i = 0; i < model->gltf->weight_count; i++) {
            if (i > 0) fputs(", ", model->out);
            usda_string(model->out, model->shapes[i].token);
        }
        fputs("]\n", model->out);
        write_samples(model, "float[] blendShapeWeights", WEIGHTS);
    }
    fputs("        }\n\n", model->out);
}

// --- materials

static void begin_shader(FILE *out, const char *name, const char *id)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"%s\"\n", id);
}

/// A shader that reads an array of the vertices.
static void read_primvar(FILE *out, const char *name, const char *type, const char *array)
{
    fprintf(out, "\n                def Shader \"%s\"\n                {\n", name);
    fprintf(out, "                    uniform token info:id = \"UsdPrimvarReader_%s\"\n", type);
    fprintf(out, "                    string inputs:varname = \"%s\"\n", array);
    fprintf(out, "                    %s outputs:result\n                }\n", type);
}

/// "input.connect = </…>", to an output of another shader of the material.
static void connect(const struct usda_model *model, const char *material, const char *input, const char *output)
{
    fprintf(model->out, "                    %s.connect = </scene/%s/materials/%s/%s>\n", input, model->name,
            material, output);
}

static const char *wrap_of(int wrap)
{
    return wrap == GLTF_CLAMPED ? "clamp" : wrap == GLTF_MIRRORED ? "mirror" : "repeat";
}

/// Names all materials and writes them, and their textures' files.
static bool write_materials(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    FILE *out = model->out;
    // A picture is written once; the name behind the last stays empty.
    char(*files)[PATH_LIMIT] = need_zeroed((size_t)gltf->image_count + 1, sizeof *files);
    // Whether a material's vertices have colours of their own.
    bool *colored = need_zeroed((size_t)gltf->material_count + 1, sizeof *colored);
    bool done = true;
    for (int m = 0; m < gltf->mesh_count; m++) {
        for (int p = 0; p < gltf->meshes[m].part_count; p++) {
            const struct gltf_part *part = &gltf->meshes[m].parts[p];
            bool *is_colored = part->material >= 0 && part->color ? &colored[part->material] : NULL;
            for (int i = 0; is_colored && !*is_colored && i < part->vertex_count; i++) {
                const float *c = part->color[i];
                *is_colored = c[0] != 1 || c[1] != 1 || c[2] != 1;
            }
        }
    }
    fputs("        def Scope \"materials\"\n        {\n", out);
    for (int i = 0; done && i < gltf->material_count; i++) {
        const struct gltf_material *m = &gltf->materials[i];
        const struct gltf_image *image = m->image >= 0 ? &gltf->images[m->image] : NULL; // NULL: it has none to show
        const float *c = m->color;
        const char *name = model->materials[i] = usda_name(&model->material_prims, m->name, false);
        char *const file = image ? files[m->image] : files[gltf->image_count];
        if (image && !*file) { // into a folder called as the .usda: "walk.usda" → "walk_textures"
            const char *path = model->range->path, *own = path_name(path), *dot = strrchr(path, '.');
            char picture[80], folder[PATH_LIMIT];
            struct names none = no_names;
            snprintf(picture, sizeof picture, "%s_%d.%s", usda_name(&none, image->name ? image->name : name, false),
                     model->range->sidecars.count, image->bytes[0] == 0xFF ? "jpg" : "png");
            names_free(&none);
            char *stem = name_from(own, dot ? (size_t)(dot - own) : strlen(own));
            snprintf(folder, PATH_LIMIT, "%.*s%s_textures", (int)(own - path), path, stem);
            free(stem);
            if (snprintf(file, PATH_LIMIT, "./%s/%s", path_name(folder), picture) >= PATH_LIMIT)
                done = fail(error, ERROR_INPUT, "%s: the path is too long", folder);
            done = done && sidecars_add(&model->range->sidecars, folder, picture, image->bytes, image->size, error);
            if (!done) break;
        }
        const bool is_plain = !colored[i];
        usda_begin(out, 12, "Material", name, m->name, NULL);
        fprintf(out,
                "                token outputs:surface.connect = </scene/%s/materials/%s/surface.outputs:surface>\n",
                model->name, name);
        begin_shader(out, "surface", "UsdPreviewSurface");
        if (is_plain && !*file) {
            usda_vector(out, "                    color3f inputs:diffuseColor = ", c);
            fputc('\n', out);
        } else {
            connect(model, name, "color3f inputs:diffuseColor",
                    *file ? "texture.outputs:rgb" : "color.outputs:result");
        }
        if ((m->blended || m->cutoff > 0) && *file) {
            connect(model, name, "float inputs:opacity", "texture.outputs:a");
        } else if (m->blended) {
            fprintf(out, "                    float inputs:opacity = %.9g\n", (double)c[3]);
        }
        if (m->cutoff > 0)
            fprintf(out, "                    float inputs:opacityThreshold = %.9g\n", (double)m->cutoff);
        if (m->shines) {
            fprintf(out, "                    float inputs:metallic = %.9g\n", m->metallic);
            fprintf(out, "                    float inputs:roughness = %.9g\n", m->roughness);
        }
        fputs("                    token outputs:surface\n                }\n", out);

        if (*file) {
            const char *quote = strchr(file, '@') ? "@@@" : "@";
            begin_shader(out, "texture", "UsdUVTexture");
            fprintf(out, "                    asset inputs:file = %s%s%s\n", quote, file, quote);
            fprintf(out, "                    float4 inputs:scale = (%.9g, %.9g, %.9g, %.9g)\n", (double)c[0],
                    (double)c[1], (double)c[2], (double)c[3]);
            fputs("                    token inputs:sourceColorSpace = \"sRGB\"\n", out);
            connect(model, name, "float2 inputs:st", "st.outputs:result");
            fprintf(out, "                    token inputs:wrapS = \"%s\"\n", wrap_of(m->sampler.wrap[0]));
            fprintf(out, "                    token inputs:wrapT = \"%s\"\n", wrap_of(m->sampler.wrap[1]));
            fputs("                    float outputs:a\n                    float3 outputs:rgb\n                }\n",
                  out);
            read_primvar(out, "st", "float2", "st");
        } else if (!is_plain) { // colours by vertex hold the material's own
            read_primvar(out, "color", "float3", "displayColor");
        }
        fputs("            }\n\n", out);
    }
    fputs("        }\n", out);
    free(colored);
    free(files);
    return done;
}

// --- meshes, bound to skeletons: vertices are in the order of the .pc2

/// Parts of a node's mesh, one after the other, that are a prim: all of them, unless some have a skin or normals and some have not.
struct run {
    struct usda_model *model;
    int node;
    const struct gltf_part *parts;
    int count;
    int influences; ///< joints a vertex; 0: all hangs at the node's own
    const char *name;
    struct run_vertex {
        const struct gltf_part *part;
        int number; ///< in that
    } * vertices;   ///< of the prim
    int vertex_count;
    uint32_t *first; ///< of each part: the vertex of the prim that its first one is
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

/// Lists the vertices. A part that has those of the first shares them, except of a character, whose materials may differ in colour; where
/// texture coordinates differ it has its own.
static void list_vertices(struct run *run)
{
    struct pool *pool = &run->model->pool;
    size_t most = 0;
    for (int p = 0; p < run->count; p++) most += (size_t)run->parts[p].vertex_count;
    run->first = pool_take(pool, (size_t)run->count, sizeof *run->first);
    run->vertices = pool_take(pool, most, sizeof *run->vertices);
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p], *one = run->parts;
        if (run->model->is_own && p > 0 && part->position == one->position && part->uv == one->uv) continue;
        run->first[p] = (uint32_t)run->vertex_count;
        for (int v = 0; v < part->vertex_count; v++)
            run->vertices[run->vertex_count++] = (struct run_vertex){part, v};
    }
}

// --- arrays by vertex

enum usda_array { POINTS, NORMALS, UVS, JOINT_INDICES, JOINT_WEIGHTS };

/// Marks an array as one per vertex, with `each` elements for each; 0: one.
static void end_by_vertex(FILE *out, int each)
{
    fputs(" (\n", out);
    if (each > 0) fprintf(out, "                elementSize = %d\n", each);
    fputs("                interpolation = \"vertex\"\n            )\n", out);
}

static void write_vertices(const struct run *run, const char *declaration, enum usda_array array)
{
    const struct usda_model *model = run->model;
    FILE *out = model->out;
    fprintf(out, "            %s = [", declaration);
    for (int n = 0; n < run->vertex_count; n++) {
        const struct gltf_part *part = run->vertices[n].part;
        const int v = run->vertices[n].number;
        const char *before = n > 0 ? ", " : "";
        const float *uv = array == UVS && part->uv ? part->uv[v] : (const float[]){0, 0};
        if (array == POINTS) usda_vector(out, before, part->position[v]);
        if (array == NORMALS) usda_vector(out, before, part->normal[v]);
        if (array == UVS) fprintf(out, "%s(%.9g, %.9g)", before, (double)uv[0], 1 - (double)uv[1]); // upwards
        for (int i = 0; array >= JOINT_INDICES && i < run->influences; i++) {
            const float weight = part->weights[v][i];
            const int slot = weight != 0 ? part->joints[v][i] : 0;
            fputs(i > 0 ? ", " : before, out);
            if (array == JOINT_WEIGHTS) {
                fprintf(out, "%.9g", (double)weight);
            } else {
                fprintf(out, "%d", model->joint_of[model->gltf->skins[skeleton_of(run)].joints[slot]]);
            }
        }
    }
    fputs("]", out);
    if (array == POINTS) {
        fputc('\n', out);
    } else {
        end_by_vertex(out, array >= JOINT_INDICES ? run->influences : 0);
    }
}

/// The index behind the polygon that begins at index `i`.
static int polygon_end(const struct gltf_part *part, int i)
{
    for (i += 3; i < part->index_count && gltf_joins(part, i);) i += 3;
    return i;
}

// --- blend shapes

/// How far a target takes the vertices, or turns the normals, of all parts.
static void write_offsets(const struct run *run, int target, bool normals)
{
    static const float still[3] = {0};
    FILE *out = run->model->out;
    fprintf(out, "                uniform vector3f[] %s = [", normals ? "normalOffsets" : "offsets");
    for (int n = 0; n < run->vertex_count; n++) {
        const struct gltf_target *of = &run->vertices[n].part->targets[target];
        const float(*by)[3] = normals ? of->normal : of->position;
        usda_vector(out, n > 0 ? ", " : "", by ? by[run->vertices[n].number] : still);
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

static void write_run(struct run *run)
{
    const struct usda_model *model = run->model;
    FILE *out = model->out;
    // The joints that a vertex has at most; where a part has no skin, all of the run's have none.
    const bool is_skinned = has_skin(model, run->node, run->parts);
    list_vertices(run);
    for (int n = 0; is_skinned && n < run->vertex_count; n++) {
        for (int k = run->influences; k < GLTF_INFLUENCES; k++) {
            if (run->vertices[n].part->weights[run->vertices[n].number][k] != 0) run->influences = k + 1;
        }
    }
    if (is_skinned && run->influences == 0) run->influences = 1;
    const char *before = "";
    bool double_sided = false, has_uv = false;
    int face = 0;
    for (int p = 0; p < run->count; p++) {
        const int material = run->parts[p].material;
        double_sided = double_sided || (material >= 0 && model->gltf->materials[material].double_sided);
        has_uv = has_uv || run->parts[p].uv;
    }
    fputc('\n', out);
    usda_begin(out, 8, "Mesh", run->name, model->gltf->nodes[run->node].name, "SkelBindingAPI");
    if (double_sided) fputs("            uniform bool doubleSided = 1\n", out);
    write_vertices(run, "point3f[] points", POINTS);
    if (run->parts->normal) write_vertices(run, "normal3f[] normals", NORMALS);

    // The material's colour times the vertex's: where two materials meet, that of the later triangle.
    const int count = run->vertex_count;
    float(*tint)[3] = need(((size_t)count + 1), sizeof *tint);
    for (int i = 0; i < 3 * count; i++) tint[i / 3][i % 3] = 1;
    for (int p = 0; p < run->count; p++) {
        const struct gltf_part *part = &run->parts[p];
        for (int i = 0; i < part->index_count; i++) {
            const uint32_t v = part->indices[i];
            for (int k = 0; k < 3; k++)
                tint[run->first[p] + v][k] =
                    (part->color ? part->color[v][k] : 1) *
                    (part->material >= 0 ? model->gltf->materials[part->material].color[k] : 1);
        }
    }
    fputs("            color3f[] primvars:displayColor = [", out);
    for (int i = 0; i < count; i++) usda_vector(out, i > 0 ? ", " : "", tint[i]);
    fputs("]", out);
    end_by_vertex(out, 0);
    free(tint);
    if (has_uv) write_vertices(run, "texCoord2f[] primvars:st", UVS);

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
        for (int i = 0; i < part->index_count; i++) {
            if (i % 3 < 2 && gltf_joins(part, i - i % 3)) continue;
            fprintf(out, "%s%u", before, run->first[p] + part->indices[i]);
            before = ", ";
        }
    }
    fputs("]\n            uniform token subdivisionScheme = \"none\"\n", out);

    if (run->influences > 0) {
        write_vertices(run, "int[] primvars:skel:jointIndices", JOINT_INDICES);
        write_vertices(run, "float[] primvars:skel:jointWeights", JOINT_WEIGHTS);
    } else { // bound to the node's own joint
        const int joint = model->joint_of[run->node];
        double bind[16];
        usda_bind(run->model, skeleton_of(run), joint, bind);
        static const char once[] = " (\n                elementSize = 1\n"
                                   "                interpolation = \"constant\"\n            )\n";
        fprintf(out, "            int[] primvars:skel:jointIndices = [%d]%s", joint, once);
        fprintf(out, "            float[] primvars:skel:jointWeights = [1]%s", once);
        fputs("            matrix4d primvars:skel:geomBindTransform = ", out);
        usda_matrix(out, bind);
        fputc('\n', out);
    }
    fprintf(out, "            rel skel:skeleton = </scene/%s/%s>\n", model->name, model->skeletons[skeleton_of(run)]);
    write_shapes(run);

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
            fprintf(out, "                rel material:binding = </scene/%s/materials/%s>\n", model->name,
                    model->materials[part->material]);
        fputs("            }\n", out);
    }
    fputs("        }\n", out);
}

// --- all of it

/// Writes the prim of a rig. False with a sentence. All of the model but what it is made of is zero.
static bool usda_model_write(struct usda_model *model, struct error *error)
{
    const struct gltf *gltf = model->gltf;
    const size_t keys = (size_t)model->range->key_count, nodes = (size_t)gltf->node_count,
                 weights = (size_t)gltf->weight_count;
    const int skeletons = gltf->skin_count > 1 ? gltf->skin_count : 1;
    struct gltf_pose pose = {0};
    struct pool *pool = &model->pool;
    struct names *const sets[] = {&model->prims, &model->joint_names, &model->shape_tokens, &model->shape_prims,
                                  &model->material_prims};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) *sets[i] = no_names;
    const bool room = need_has_room(keys * (nodes * sizeof *model->places + weights * sizeof *model->weights));
    if (room) {
        model->places = pool_take(pool, keys * nodes, sizeof *model->places);
        model->weights = pool_take(pool, keys * weights, sizeof *model->weights);
        model->shapes = pool_take(pool, weights, sizeof *model->shapes);
        model->joints = pool_take(pool, 2 * nodes, sizeof *model->joints);
        model->joint_of = pool_take(pool, nodes, sizeof *model->joint_of);
        model->materials = pool_take(pool, (size_t)gltf->material_count, sizeof *model->materials);
        model->skeletons = pool_take(pool, (size_t)gltf->skin_count + 1, sizeof *model->skeletons);
    }
    bool done = (room && gltf_pose_create(gltf, &pose)) || fail_no_memory(error, gltf->path);
    struct rig_pose posed;
    for (int k = 0; done && k < model->range->key_count; k++) { // as the scene has it, or as its clip says
        const struct gltf_pose *now = &pose;
        struct gltf_place *at = model->places + (size_t)k * nodes;
        if (model->is_own) {
            gltf_pose_clip(gltf, gltf->clip_count > 0 ? 0 : -1, (float)range_seconds(model->range, k), &pose);
        } else {
            done = range_pose(model->range, model->rig, k, &posed, error) && range_proceed(model->range, error);
            if (!done) break;
            now = posed.model.pose;
        }
        memcpy(at, now->place, nodes * sizeof *at);
        memcpy(model->weights + (size_t)k * weights, now->weights, weights * sizeof *model->weights);
        for (size_t n = 0; n < nodes; n++)
            keys_turn_short_way(k > 0 ? (at + n - nodes)->rotation : gltf->nodes[n].place.rotation, at[n].rotation);
    }
    if (done) {
        keys_close_loop((float *)model->places, gltf->node_count * (int)(sizeof *model->places / sizeof(float)),
                        model->range->key_count);
        keys_close_loop(model->weights, gltf->weight_count, model->range->key_count);
        make_joints(model);
    }

    // Targets are called as in the file (a custom of many exporters), else by number; those of all nodes together differ.
    for (int n = 0; done && n < gltf->node_count; n++) {
        const struct gltf_mesh *mesh = gltf->nodes[n].mesh >= 0 ? &gltf->meshes[gltf->nodes[n].mesh] : NULL;
        for (int t = 0; mesh && t < mesh->target_count; t++) {
            struct usda_shape *shape = &model->shapes[gltf->nodes[n].first_weight + t];
            shape->token = names_add(&model->shape_tokens, gltf_target_label(mesh, t, pool));
            shape->prim = usda_name(&model->shape_prims, shape->token, false);
        }
    }

    if (done) {
        fputc('\n', model->out);
        usda_begin(model->out, 4, "SkelRoot", model->name,
                   form_name(model->range->posing->document->rigs[model->rig]), NULL);
        done = range_pose(model->range, model->rig, 0, &posed, error);
    }
    const float *root = done ? range_root(model->range, model->rig, &posed) : NULL;
    if (root) { // where it stands, which does not move
        double matrix[16];
        for (int i = 0; i < 16; i++) matrix[i] = (double)root[i];
        fputs("        matrix4d xformOp:transform = ", model->out);
        usda_matrix(model->out, matrix);
        fputs("\n        uniform token[] xformOpOrder = [\"xformOp:transform\"]\n\n", model->out);
    }
    if (done) {
        for (int s = 0; s < skeletons; s++) model->skeletons[s] = usda_name(&model->prims, "skeleton", false);
        usda_name(&model->prims, "animation", false);
        usda_name(&model->prims, "materials", false);
        for (int s = 0; s < skeletons; s++) write_skeleton(model, s);
        if (is_animated(model)) write_animation(model);
        done = write_materials(model, error);
    }
    for (int n = 0; done && n < gltf->node_count; n++) {
        const struct gltf_mesh *mesh = gltf->nodes[n].mesh >= 0 ? &gltf->meshes[gltf->nodes[n].mesh] : NULL;
        for (int p = 0, end; mesh && p < mesh->part_count; p = end) {
            struct run run = {.model = model, .node = n, .parts = mesh->parts + p};
            const bool skinned = has_skin(model, n, run.parts), is_flat = !run.parts->normal;
            end = p;
            while (end < mesh->part_count && has_skin(model, n, &mesh->parts[end]) == skinned &&
                   !mesh->parts[end].normal == is_flat)
                end++;
            run.count = end - p;
            run.name = usda_name(&model->prims, gltf->nodes[n].name, false);
            write_run(&run);
        }
    }
    fputs("    }\n", model->out);
    gltf_pose_free(&pose);
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) names_free(sets[i]);
    pool_free(pool);
    return done;
}

bool usda_write(struct export_range *range, FILE *out, struct error *error)
{
    struct names names = no_names;
    bool done = true;
    fprintf(out, "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n");
    fprintf(out, "    startTimeCode = %.9g\n    endTimeCode = %.9g\n    timeCodesPerSecond = %.9g\n)\n",
            range_frame(range, 0), range_frame(range, range->key_count - 1), range->posing->document->fps);
    fputs("\ndef Xform \"scene\"\n{", out);
    for (int r = 0; done && r < range->rig_count; r++) {
        const int rig = range->rigs[r];
        const struct rig *source = range->posing->document->rigs[rig];
        struct usda_model model = {
            .range = range, .rig = rig, .name = usda_name(&names, form_name(source), false), .out = out};
        struct rig_pose pose;
        struct gltf gltf = {0};
        model.is_own = !(form_kind(range->posing, rig)->holds & FORM_FILE);
        if (model.is_own) { // read back from the glTF file that it would be
            char *data = NULL;
            size_t size = 0;
            FILE *file = open_memstream(&data, &size);
            const bool made = file && gltf_write_scene(range, &rig, 1, true, file, error);
            const bool whole = file && fclose(file) == 0;
            if (!made || !whole) {
                free(data);
                done = file && !made ? false : fail_no_memory(error, range->path);
            }
            done = done && gltf_read_bytes(form_name(source), data, size, &gltf, error);
        } else {
            done = range_pose(range, rig, 0, &pose, error);
        }
        if (!done) break;
        model.gltf = model.is_own ? &gltf : form_gltf(&pose, &model.pool);
        done = usda_model_write(&model, error);
        gltf_free(&gltf);
    }
    fputs("}\n", out);
    names_free(&names);
    snprintf(range->summary, FORMAT_SUMMARY, "%d rig%s, %d keys", range->rig_count, range->rig_count == 1 ? "" : "s",
             range->key_count);
    if (range->sidecars.count == 0) return done;
    const char *folder = path_name(range->sidecars.folder);
    print_more(range->summary, FORMAT_SUMMARY, ", %d texture%s in %.*s", range->sidecars.count,
               range->sidecars.count == 1 ? "" : "s", name_fit(folder, 40), folder);
    return done;
}
