/// Rigs as a USD scene in text: UsdSkel skeletons, blend shapes, a time sample a key. Metres, y up; time codes are the document's frames.
#include "base/path.h"
#include "export/format.h"
#include "export/keys.h"
#include "export/targets.h"
#include "export/usda_form.h"
#include "export/usda_model.h"
#include "export/usda_text.h"
#include <stdlib.h>
#include <string.h>

/// One rig being written.
struct prim {
    const struct shot *shot;
    const struct form *form;
    const struct keys *keys;
    const struct file_targets *targets;
    FILE *out;
    const char *name;
    struct usda_form *faces;
};

static void write_interpolated(FILE *out, const char *declaration, const float (*vectors)[3], int count)
{
    usda_vectors(out, declaration, vectors, count);
    usda_by_vertex(out, 0);
}

static void begin_sample(const struct prim *prim, int key)
{
    fprintf(prim->out, "                %.9g: ", shot_frame(prim->shot, key));
}

// --- the skeleton. A rig without joints has one that carries it.

static int joint_count(const struct form *form) { return form->joint_count > 0 ? form->joint_count : 1; }

/// The path of a joint from the root: "tail/tail_0/tail_1".
static void write_path(FILE *out, const struct form *form, int j)
{
    char name[FORM_NAME];
    if (form->joint_count == 0) {
        fputs("root", out);
        return;
    }
    if (form->joints[j].parent >= 0) {
        write_path(out, form, form->joints[j].parent);
        fputc('/', out);
    }
    usda_identifier(form->joints[j].name, name);
    fputs(name, out);
}

static void write_joints(const struct prim *prim)
{
    fputs("            uniform token[] joints = [", prim->out);
    for (int j = 0; j < joint_count(prim->form); j++) {
        fputs(j > 0 ? ", \"" : "\"", prim->out);
        write_path(prim->out, prim->form, j);
        fputc('"', prim->out);
    }
    fputs("]\n", prim->out);
}

static void write_places(const struct prim *prim, const char *declaration, bool bind)
{
    static const float origin[3] = {0};
    const struct form *form = prim->form;
    fprintf(prim->out, "            %s = [", declaration);
    for (int j = 0; j < joint_count(form); j++) {
        const float *p = form->joint_count == 0 ? origin : bind ? form->joints[j].bind : form->joints[j].offset;
        fprintf(prim->out, "%s((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (%.9g, %.9g, %.9g, 1))", j > 0 ? ", " : "",
                (double)p[0], (double)p[1], (double)p[2]);
    }
    fputs("]\n", prim->out);
}

static void write_skeleton(const struct prim *prim)
{
    fputs("        def Skeleton \"skeleton\" (\n            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n   "
          "     {\n",
          prim->out);
    write_joints(prim);
    write_places(prim, "uniform matrix4d[] bindTransforms", true);
    write_places(prim, "uniform matrix4d[] restTransforms", false);
    fprintf(prim->out, "            rel skel:animationSource = </scene/%s/animation>\n        }\n\n", prim->name);
}

// --- what moves it

static void write_rotations(const struct prim *prim, int key)
{
    const struct keys *keys = prim->keys;
    fputs("[", prim->out);
    for (int j = 0; j < joint_count(prim->form); j++) {
        static const float upright[4] = {0, 0, 0, 1};
        const float *q = prim->form->joint_count > 0 ? keys->at.rotation[j * keys->count + key] : upright;
        fprintf(prim->out, "%s(%.9g, %.9g, %.9g, %.9g)", j > 0 ? ", " : "", (double)q[3], (double)q[0], (double)q[1],
                (double)q[2]);
    }
    fputs("],\n", prim->out);
}

static void write_translations(const struct prim *prim, int key)
{
    fputs("[", prim->out);
    for (int j = 0; j < joint_count(prim->form); j++) {
        const float *p = j == 0 ? prim->keys->at.translation[key] : prim->form->joints[j].offset;
        fprintf(prim->out, "%s(%.9g, %.9g, %.9g)", j > 0 ? ", " : "", (double)p[0], (double)p[1], (double)p[2]);
    }
    fputs("],\n", prim->out);
}

static void write_scales(const struct prim *prim, int key)
{
    fputs("[", prim->out);
    for (int j = 0; j < joint_count(prim->form); j++) {
        static const float whole[3] = {1, 1, 1};
        const float *s = prim->form->joint_count > 0 ? prim->keys->at.scale[j * prim->keys->count + key] : whole;
        fprintf(prim->out, "%s(%.6g, %.6g, %.6g)", j > 0 ? ", " : "", (double)s[0], (double)s[1], (double)s[2]);
    }
    fputs("],\n", prim->out);
}

static void write_weights(const struct prim *prim, int key)
{
    fputs("[", prim->out);
    for (int t = 0; t < prim->targets->count; t++) {
        fprintf(prim->out, "%s%.9g", t > 0 ? ", " : "", (double)targets_weight(prim->targets, t, prim->keys, key));
    }
    fputs("],\n", prim->out);
}

static void write_samples(const struct prim *prim, const char *declaration,
                          void (*write)(const struct prim *prim, int key), int count)
{
    fprintf(prim->out, "            %s.timeSamples = {\n", declaration);
    for (int k = 0; k < count; k++) {
        begin_sample(prim, k);
        write(prim, k);
    }
    fputs("            }\n", prim->out);
}

static void write_target_names(const struct prim *prim, const char *declaration, const char *before,
                               const char *after)
{
    char name[FORM_NAME];
    fprintf(prim->out, "            %s = [", declaration);
    for (int t = 0; t < prim->targets->count; t++) {
        usda_identifier(prim->targets->list[t].name, name);
        fprintf(prim->out, "%s%s%s%s", t > 0 ? ", " : "", before, name, after);
    }
    fputs("]\n", prim->out);
}

static void write_animation(const struct prim *prim)
{
    const struct keys *keys = prim->keys;
    fputs("        def SkelAnimation \"animation\"\n        {\n", prim->out);
    write_joints(prim);
    write_samples(prim, "float3[] translations", write_translations, keys->travels ? keys->count : 1);
    write_samples(prim, "quatf[] rotations", write_rotations, prim->form->joint_count > 0 ? keys->count : 1);
    write_samples(prim, "half3[] scales", write_scales, prim->form->joint_count > 0 ? keys->count : 1);
    if (prim->targets->count > 0) {
        write_target_names(prim, "uniform token[] blendShapes", "\"", "\"");
        write_samples(prim, "float[] blendShapeWeights", write_weights, keys->count);
    }
    fputs("        }\n\n", prim->out);
}

// --- the mesh

static void write_binding(const struct prim *prim)
{
    const struct form *form = prim->form;
    const int each = form->joint_count > 0 ? FORM_INFLUENCES : 1;
    fputs("            int[] primvars:skel:jointIndices = [", prim->out);
    for (int i = 0; i < each * form->vertex_count; i++)
        fprintf(prim->out, "%s%d", i > 0 ? ", " : "", form->joint_count > 0 ? form->slots[i / each][i % each] : 0);
    fputs("]", prim->out);
    usda_by_vertex(prim->out, each);
    fputs("            float[] primvars:skel:jointWeights = [", prim->out);
    for (int i = 0; i < each * form->vertex_count; i++) {
        fprintf(prim->out, "%s%.9g", i > 0 ? ", " : "",
                form->joint_count > 0 ? (double)form->weights[i / each][i % each] : 1.0);
    }
    fputs("]", prim->out);
    usda_by_vertex(prim->out, each);
}

static void write_shapes(const struct prim *prim, float (*scratch)[3])
{
    const struct form *form = prim->form;
    char name[FORM_NAME];
    for (int t = 0; t < prim->targets->count; t++) {
        const struct file_target *target = &prim->targets->list[t];
        usda_identifier(target->name, name);
        fprintf(prim->out, "\n            def BlendShape \"%s\"\n            {\n    ", name);
        targets_scale(target, form->targets[target->source].position, form->vertex_count, scratch);
        usda_vectors(prim->out, "uniform vector3f[] offsets", (const float(*)[3])scratch, form->vertex_count);
        fputs("\n    ", prim->out);
        targets_scale(target, form->targets[target->source].normal, form->vertex_count, scratch);
        usda_vectors(prim->out, "uniform vector3f[] normalOffsets", (const float(*)[3])scratch, form->vertex_count);
        fputs("\n            }\n", prim->out);
    }
}

static void write_mesh(const struct prim *prim, float (*scratch)[3])
{
    const struct form *form = prim->form;
    char before[2 * FORM_NAME];
    fputs(
        "        def Mesh \"mesh\" (\n            prepend apiSchemas = [\"SkelBindingAPI\"]\n        )\n        {\n",
        prim->out);
    usda_vectors(prim->out, "point3f[] points", form->position, form->vertex_count);
    fputc('\n', prim->out);
    write_interpolated(prim->out, "normal3f[] normals", form->normal, form->vertex_count);
    usda_form_faces(prim->faces);
    write_binding(prim);
    fprintf(prim->out, "            rel skel:skeleton = </scene/%s/skeleton>\n", prim->name);
    if (prim->targets->count > 0) {
        write_target_names(prim, "uniform token[] skel:blendShapes", "\"", "\"");
        snprintf(before, sizeof before, "</scene/%s/mesh/", prim->name);
        write_target_names(prim, "rel skel:blendShapeTargets", before, ">");
    }
    write_shapes(prim, scratch);
    usda_form_subsets(prim->faces);
    fputs("        }\n", prim->out);
}

// --- all of it

/// Rigs may have the same name, prims may not.
static void name_prim(const struct shot *shot, const struct form *form, int rig, char name[FORM_NAME])
{
    char wanted[FORM_NAME + 16];
    snprintf(wanted, sizeof wanted, "%.40s", form->name);
    for (int r = 0; r < rig; r++) {
        if (strncmp(form_name(&shot->posing->document->rigs[r]), form->name, 40) != 0) continue;
        snprintf(wanted, sizeof wanted, "%.40s_%d", form->name, rig);
        break;
    }
    usda_identifier(wanted, name);
}

static bool write_form(struct shot *shot, const struct form *form, int rig, const char *name, FILE *out,
                       struct error *error)
{
    struct keys keys;
    struct file_targets targets = {0};
    if (!keys_collect(shot, rig, form, &keys, error)) return false;
    float(*scratch)[3] = malloc(((size_t)form->vertex_count + 1) * sizeof *scratch);
    struct usda_form faces = {.form = form, .rig = name, .out = out};
    bool done = (scratch && targets_create(shot, form, &keys, &targets)) || fail_no_memory(error, form->name);
    if (done) {
        const struct prim prim = {.shot = shot,
                                  .form = form,
                                  .keys = &keys,
                                  .targets = &targets,
                                  .out = out,
                                  .name = name,
                                  .faces = &faces};
        fprintf(out, "\n    def SkelRoot \"%s\"\n    {\n", name);
        write_skeleton(&prim);
        write_animation(&prim);
        done = usda_form_open(&faces, shot, error);
        if (done) write_mesh(&prim, scratch);
        fputs("    }\n", out);
    }
    usda_form_close(&faces);
    free(scratch);
    targets_free(&targets);
    keys_free(&keys);
    return done;
}

static bool write_rig(struct shot *shot, int rig, FILE *out, struct error *error)
{
    struct form form;
    char name[FORM_NAME];
    if (!form_open(shot, rig, &form, error)) return false;
    name_prim(shot, &form, rig, name);
    const bool done = form.kind->holds & FORM_FILE ? usda_model_write(shot, rig, name, out, error)
                                                   : write_form(shot, &form, rig, name, out, error);
    form_close(&form);
    return done;
}

static void summarise(const struct shot *shot, char summary[FORMAT_SUMMARY])
{
    const int used = snprintf(summary, FORMAT_SUMMARY, "%d rig%s, %d keys", shot->rig_count,
                              shot->rig_count == 1 ? "" : "s", shot->key_count);
    if (shot->beside.count == 0) return;
    snprintf(summary + used, FORMAT_SUMMARY - (size_t)used, ", %d texture%s in %.40s", shot->beside.count,
             shot->beside.count == 1 ? "" : "s", path_name(shot->beside.folder));
}

bool usda_write(struct shot *shot, FILE *out, char summary[FORMAT_SUMMARY], struct error *error)
{
    bool done = true;
    shot->total = (long)shot->key_count * shot->rig_count;
    shot->is_cubic = false;
    fprintf(out, "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n");
    fprintf(out, "    startTimeCode = %.9g\n    endTimeCode = %.9g\n    timeCodesPerSecond = %.9g\n)\n",
            shot_frame(shot, 0), shot_frame(shot, shot->key_count - 1), shot->posing->document->fps);
    fputs("\ndef Xform \"scene\"\n{", out);
    for (int r = 0; done && r < shot->rig_count; r++) done = write_rig(shot, shot->rigs[r], out, error);
    fputs("}\n", out);
    summarise(shot, summary);
    return done;
}
