/// Shows foxes on the stage.
#include "ui/stage.h"
#include <math.h>

static const float DUSK = 0.35f; ///< of a fox of bind size

/// The box around it. Skin follows joints that are at most 2.5 segments away (model/fox.c), so it stays within a sphere around each.
static void find_box(const struct pose *pose, struct stage_model *shown)
{
    const float segment = pose_length(pose) / (float)(pose->count - 1);
    const float reach = hypotf(2.5f * segment, FOX_BRUSH_RADIUS * pose_scale(pose));
    pose_bounds(pose, shown->lo, shown->hi);
    for (int n = 0; n < pose->count; n++) {
        for (int k = 0; k < 3; k++) {
            shown->lo[k] = fminf(shown->lo[k], pose->matrix[n][12 + k] - reach);
            shown->hi[k] = fmaxf(shown->hi[k], pose->matrix[n][12 + k] + reach);
        }
    }
}

void stage_add_fox(struct stage_view *view, const struct fox *fox, const struct pose *pose)
{
    struct stage_model *shown = &view->models[view->model_count++];
    *shown = (struct stage_model){
        .gltf = &fox->gltf, .pose = &fox->pose, .ground = pose->ground, .dusk = DUSK * pose_scale(pose)};
    for (int k = 0; k < 4; k++) shown->root[5 * k] = 1.0f;
    fox_pose(fox, pose);
    find_box(pose, shown);
}
