/// Poses single points of rigs.
#include "editor/stage/points.h"
#include "editor/core/bones.h"
#include "editor/stage/rigs.h"
#include <string.h>

bool point_exists(const struct editor_world *world, struct rig_point point)
{
    const struct document *document = world->document;
    if (point.rig < 0 || point.rig >= document->rig_count) return false;
    const enum rig_kind kind = document->rigs[point.rig].kind;
    if (point.at < 0) return point.at == POINT_BASE && kind == RIG_TAIL;
    if (kind == RIG_TAIL || kind == RIG_CHAIN) return point.at < bones_joints(world, point.rig);
    const int n = document_rig_number(document, point.rig);
    const struct figure *figure = kind == RIG_CHARACTER ? models_figure(world->models, n) : NULL;
    return figure && point.at < figure->character.vertex_count;
}

/// Out of a posed rig.
static void take_place(const struct rig_pose *pose, int at, float place[3])
{
    if (pose->kind == RIG_CHARACTER) {
        const struct figure *figure = pose->character.figure;
        morph_vertex(figure, &pose->character.morph, at, place, NULL);
        for (int k = 0; k < 3; k++) place[k] += pose->character.position[k] - (k == 1 ? figure->lo[1] : 0.0f);
    } else {
        const float *end = pose->kind == RIG_CHAIN ? pose->chain.point[at + 1] : pose->tail.matrix[at + 1] + 12;
        memcpy(place, end, 3 * sizeof *place);
    }
}

bool point_place(const struct core *core, const struct editor_world *world, struct rig_point point, double position,
                 float place[3])
{
    struct rig_pose pose;
    const struct posing posing = stage_posing(core, world);
    if (!point_exists(world, point) || !rig_pose(&posing, point.rig, position, NULL, &pose)) return false;
    take_place(&pose, point.at, place);
    return true;
}
