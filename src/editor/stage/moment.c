/// What the pointer was over a moment ago: a hand is slower than a tail that swings.
#include "editor/core/core.h"
#include "editor/core/playback.h"
#include "editor/stage/hold.h"
#include "editor/stage/rigs.h"
#include "editor/stage/strand.h"
#include <math.h>

static const double MOMENT = 0.35, STEP = 1.0 / 60; ///< seconds; between two steps a tail moves less than its reach

/// The position that was shown some seconds ago, round the end of what is played.
static double position_ago(const struct core *core, const struct document *document, double seconds)
{
    double range[2];
    playback_range(core, document, range);
    const double first = core_position(document, range[0]), last = core_position(document, range[1]);
    const double back = seconds * document->fps * document->substeps * core->playback.speed;
    const double position = core->playback.position - back;
    return position >= first || !core->playback.looping ? fmax(position, first)
                                                        : fmax(last - (first - position), first);
}

/// The tail, chain or body that was under the point at a position, or HOVER_NONE.
static struct hover hover_at(const struct stage *stage, const struct core *core, const struct editor_world *world,
                             double position, float x, float y)
{
    const struct document *document = world->document;
    struct hover joint = {.kind = HOVER_NONE}, body = joint;
    float nearest = STRAND_REACH, farthest = INFINITY;
    for (int s = 0; s < stage->strand_count; s++) {
        const int rig = stage->strands[s].rig;
        struct strand strand;
        if (!strand_pose(stage, core, world, rig, position, NULL, &strand)) continue;
        strand_nearer(stage, core, &strand, (const float[2]){x, y}, &nearest, &joint);
    }
    for (int t = 0; t < stage->view.tail_count && document_tail(document, t); t++) {
        struct rig_pose pose;
        stage_pose_tail(stage, core, world, t, position, NULL, &pose);
        const float distance = hold_distance(stage, &pose.tail, x, y);
        if (!(distance >= 0 && distance < farthest)) continue;
        farthest = distance;
        body = (struct hover){.kind = HOVER_BODY, .tail = t, .x = x, .y = y};
    }
    return joint.kind != HOVER_NONE ? joint : body;
}

struct hover hold_moment_ago(const struct stage *stage, const struct core *core, const struct editor_world *world,
                             float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    for (double ago = STEP; core->playback.playing && ago <= MOMENT && hover.kind == HOVER_NONE; ago += STEP) {
        hover = hover_at(stage, core, world, position_ago(core, world->document, ago), x, y);
    }
    return hover;
}
