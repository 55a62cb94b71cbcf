/// An imported character as a form: the vertices of its meshes, in the space of its own file. Its own file is written by gltf_splice.c.
#include "export/form.h"

static bool open(const struct document *document, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    (void)document, (void)rig, (void)error;
    for (int n = 0; n < gltf->node_count; n++) form->vertex_count += gltf_vertex_count(gltf, n);
    return true;
}

static void close(struct form *form) { (void)form; }

static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    (void)form;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh < 0) continue;
        gltf_pose_vertices(gltf, pose->model.pose, n, positions, NULL);
        positions += gltf_vertex_count(gltf, n);
    }
}

const struct form_kind model_form = {
    .holds = FORM_VERTICES | FORM_FILE, .open = open, .close = close, .vertices = vertices};
