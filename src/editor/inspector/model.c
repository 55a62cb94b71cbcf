/// The inspector's section on imported characters: file, clip, place, selected bone.
#include "base/file.h"
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/inspector/parts.h"
#include <stdio.h>

enum { MAX_CLIPS = 256 }; ///< in the clip list

/// The shown rig: the selected bone's, else the one chosen here.
static int shown_model(const struct inspector *in)
{
    int model;
    if (bones_selected(in->core, &model) >= 0) return model;
    model = document_find_rig(in->core->document, RIG_MODEL, in->model);
    return model < 0 ? document_find_rig(in->core->document, RIG_MODEL, 0) : model;
}

static void build_file(struct inspector *in, const struct model_rig *rig, const struct imported *shown)
{
    struct rect r = inspector_labelled(in, "file");
    ui_hint(&in->ui, r, "The glTF file that shows this character");
    ui_label(&in->ui, r, path_name(rig->model), theme()->text);
    if (!shown) ui_paragraph(&in->ui, "wiggly could not read this file.", theme()->warning);
    if (!shown || !shown->gltf.not_shown) return;
    char text[512];
    snprintf(text, sizeof text, "Not shown: %.*s.", name_fit(shown->gltf.not_shown, 400), shown->gltf.not_shown);
    ui_paragraph(&in->ui, text, theme()->text_dim);
}

static void choose_clip(struct inspector *in, const struct dropdown *list)
{
    const int model = shown_model(in);
    const struct gltf *gltf = &bones_character(in->core, model)->gltf;
    const char *clip = in->core->document->rigs[model]->model.clip;
    struct ui_item items[MAX_CLIPS + 1] = {{"none", "None", 0}};
    int count = 1;
    for (int c = 0; c < gltf->clip_count && c < MAX_CLIPS; c++)
        items[count++] = (struct ui_item){gltf->clips[c].name, gltf->clips[c].name, 0};
    const int picked = ui_popup_list(&in->ui, list->name, items, count, gltf_find_clip(gltf, clip) + 1);
    if (picked >= 0)
        bones_choose_clip(in->core, model, picked > 0 ? gltf->clips[picked - 1].name : NULL, REPEAT_BY_CLIP);
}

/// A tick: whether the clip begins again after its end.
static void build_loops(struct inspector *in, int model, const struct gltf *gltf)
{
    const struct model_rig *rig = &in->core->document->rigs[model]->model;
    const int clip = gltf_find_clip(gltf, rig->clip);
    if (clip < 0) return;
    bool loops = clip_play(rig, &gltf->clips[clip]).loops;
    const struct rect r = inspector_labelled(in, "loops");
    ui_hint(&in->ui, r, "The clip begins again after its end; else it plays once");
    if (ui_toggle(&in->ui, r, "model.loops", &loops))
        bones_choose_clip(in->core, model, rig->clip, loops ? REPEAT_LOOP : REPEAT_ONCE);
}

static const struct dropdown clip_list = {"model.clips", "The clip of the file that it repeats", choose_clip};

static const struct number_row place[] = {
    {"model.x", "x", "m", "Where it stands along x", "Place character", NUMBER_AT(struct rig, model.position[0]), 0,
     0, -1e6, 1e6, 0, 0.01, 3},
    {"model.y", "y", "m", "Height of the ground under it", "Place character",
     NUMBER_AT(struct rig, model.position[1]), 0, 0, -1e6, 1e6, 0, 0.01, 3},
    {"model.z", "z", "m", "Where it stands along z", "Place character", NUMBER_AT(struct rig, model.position[2]), 0,
     0, -1e6, 1e6, 0, 0.01, 3},
    {"model.scale", "scale", NULL, "Size, relative to the file's", "Place character",
     NUMBER_AT(struct rig, model.scale), 0, 0, 1e-9, 1e9, 1, 0.01, 3},
    {"model.turn", "turn", "°", "About the vertical", "Place character", NUMBER_AT(struct rig, model.turn), -180, 180,
     -36000, 36000, 0, 1, 0},
};

static void build_bone(struct inspector *in)
{
    static const struct {
        const char *name, *label, *hint;
        bool follow;
    } buttons[] = {
        {"bone.chain", "Make chain", "Make a chain from this bone to its tip, bent by a new spline (J)", false},
        {"bone.follow", "With follow-through", "Make a chain that follows through on the clip (Shift+J)", true},
    };
    int model;
    const int node = bones_selected(in->core, &model);
    struct rect r = inspector_labelled(in, "bone");
    if (node < 0) {
        ui_label(&in->ui, r, "click one on the stage", theme()->text_dim);
        return;
    }
    ui_label(&in->ui, r, bones_character(in->core, model)->gltf.nodes[node].name, theme()->text);
    struct rect row = ui_row(&in->ui, UI_ROW);
    const float widths[2] = {row.w * 0.38f, row.w * 0.62f - 6};
    row.w = 0;
    for (size_t i = 0; i < 2; i++) {
        struct rect button = {row.x, row.y + 2, widths[i], row.h - 4};
        row.x += widths[i] + 6;
        ui_hint(&in->ui, button, buttons[i].hint);
        if (ui_button(&in->ui, button, buttons[i].name, buttons[i].label, false))
            bones_make_chain(in->core, buttons[i].follow);
    }
}

void inspector_model(struct inspector *in)
{
    const int model = shown_model(in);
    const struct imported *shown = bones_character(in->core, model);
    static const struct number_home home = {.rig = shown_model};
    in->model = document_rig_number(in->core->document, model);
    build_file(in, &in->core->document->rigs[model]->model, shown);
    const char *clip = in->core->document->rigs[model]->model.clip;
    if (shown && shown->gltf.clip_count > 0)
        inspector_dropdown(in, &clip_list, inspector_labelled(in, "clip"), in->model, clip ? clip : "None", 0);
    if (shown) build_loops(in, model, &shown->gltf);
    inspector_numbers(in, place, sizeof place / sizeof place[0], &home);
    if (shown && shown->skeleton.count > 0) build_bone(in);
}
