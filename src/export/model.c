/// An imported character as a form: its vertices, and the bones that its chains bend, as joints. All in the space of its file.
#include "base/need.h"
#include "export/form.h"
#include "rig/chain_bones.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void add_bones(struct form *form, const struct gltf *gltf, const struct chain_bones *bones)
{
    struct model_bones *own = form->owned;
    for (int n = 0; n < bones->count; n++) {
        if (own->is_bone[bones->node[n]]) continue;
        own->is_bone[bones->node[n]] = true;
        own->node[form->joint_count] = bones->node[n];
        struct form_joint *joint = &form->joints[form->joint_count++];
        *joint = (struct form_joint){.parent = -1};
        snprintf(joint->name, FORM_NAME, "%s", gltf->nodes[bones->node[n]].name);
    }
}

static bool open(const struct posing *posing, int rig, const struct rig_pose *pose, struct form *form,
                 struct error *error)
{
    const struct document *document = posing->document;
    const struct gltf *gltf = &pose->model.imported->gltf;
    const size_t nodes = (size_t)gltf->node_count + 1;
    struct model_bones *own = form->owned = need_zeroed(1, sizeof *own);
    own->gltf = gltf;
    own->node = need_zeroed(nodes, sizeof *own->node);
    own->is_bone = need_zeroed(nodes, sizeof *own->is_bone);
    form->joints = need_zeroed(nodes, sizeof *form->joints);
    for (int r = 0; r < document->rig_count; r++) {
        const struct chain *chain = &document->rigs[r]->chain;
        struct chain_bones bones;
        if (document->rigs[r]->kind != RIG_CHAIN) continue;
        if (document_find_model(document, chain->model, chain->by_file) != rig) continue;
        if (!chain_find(gltf, chain->from, chain->to, &bones, error)) return false;
        add_bones(form, gltf, &bones);
    }
    for (int n = 0; n < gltf->node_count; n++) form->vertex_count += gltf_vertex_count(gltf, n);
    return true;
}

static void close(struct form *form)
{
    struct model_bones *own = form->owned;
    if (own) {
        free(own->node);
        free(own->is_bone);
    }
    free(own);
    free(form->joints);
}

static void key(const struct form *form, const struct rig_pose *pose, struct form_key *key)
{
    const struct model_bones *own = form->owned;
    memset(key->translation, 0, sizeof key->translation);
    for (int j = 0; j < form->joint_count; j++)
        memcpy(key->rotation[j], pose->model.pose->place[own->node[j]].rotation, sizeof key->rotation[j]);
}

/// Node after node.
static void vertices(const struct form *form, const struct rig_pose *pose, float (*positions)[3])
{
    const struct gltf *gltf = &pose->model.imported->gltf;
    (void)form;
    for (int n = 0; n < gltf->node_count; n++) {
        const int count = gltf_vertex_count(gltf, n);
        if (count > 0) gltf_pose_vertices(gltf, pose->model.pose, n, positions, NULL);
        positions += count;
    }
}

/// Its chains have the columns of a table; its clip is its own.
const struct form_kind model_form = {FORM_FILE | FORM_POINTS, open, close, key, vertices, NULL};
