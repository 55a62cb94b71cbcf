/// Where points of posed tails are on the screen.
#include "editor/stage/project.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "model/vector.h"
#include <assert.h>

struct posing stage_posing(const struct core *core, const struct editor_world *world)
{
    return (struct posing){world->document, world->evaluation, world->models, core->look};
}

bool stage_project_pose(const struct stage *stage, const struct core *core, const struct pose *pose, int joint,
                        double fraction, float xy[2])
{
    const struct rect *r = &core->layout.stage;
    const float viewport[4] = {r->x, r->y, r->w, r->h};
    assert(joint >= 0 && joint < pose->count);
    int next = joint + 1 < pose->count ? joint + 1 : joint;
    const vec3s from = vec3_from(pose->matrix[joint] + 12), to = vec3_from(pose->matrix[next] + 12);
    const vec3s world = glms_vec3_lerp(from, to, (float)fraction);
    return camera_project(stage->view.view, stage->view.projection, viewport, world.raw, xy);
}

bool stage_project(const struct stage *stage, const struct core *core, int tail, int joint, double fraction,
                   float xy[2])
{
    if (tail >= stage->view.tail_count || joint >= stage->view.tails[tail].pose.count) return false;
    return stage_project_pose(stage, core, &stage->view.tails[tail].pose, joint, fraction, xy);
}
