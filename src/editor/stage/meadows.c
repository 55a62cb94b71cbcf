/// Meadows on the stage: reeds in the wind, pushed by bodies, and swinging after a body was dragged past.
#include "base/hash.h"
#include "editor/stage/parts.h"
#include "maths/maths.h"
#include "model/vector.h"
#include <math.h>
#include <string.h>

_Static_assert((int)MEADOW_MAX_REEDS <= (int)STAGE_MAX_REEDS, "the stage holds every meadow");

/// Of a body in its model's size, metres: its middle along z from the base, and the distance at which it touches reeds.
static const double MIDDLE = -0.28, REACH = 0.62;

static const double FARTHEST = 1.35; ///< radians of push right at a body
static const double STILL = 1e-3;    ///< radians, and radians per period, that nobody sees
static const double ROLL = 0.7;      ///< radians of lag per metre
static const float SHADOW = 0.55f;   ///< opacity of one disc
static const float WIDTH = 0.013f;   ///< of a reed 1 m high
static const double DEGREE = 0.017453292519943295;

/// Push of bodies on a reed, radians towards +x and +z.
static void push_of(const struct stage *stage, const float place[3], double pushed[2])
{
    pushed[0] = pushed[1] = 0;
    for (int t = 0; t < stage->tail_count; t++) {
        const struct pose *pose = &stage->strands[t].pose;
        const float *base = pose->matrix[0] + 12;
        const double scale = (double)pose->scale;
        const double x = (double)(place[0] - base[0]), z = (double)(place[2] - base[2]) - MIDDLE * scale;
        const double far = maths_hypot(x, 0.75 * z) / (REACH * scale); // an ellipse along the body
        if (!(far < 1) || !(far > 0)) continue;
        const double share = FARTHEST * (1 - far * far) * (1 - far * far) / maths_hypot(x, z);
        pushed[0] += share * x;
        pushed[1] += share * z;
    }
}

/// The reeds' oscillator; false without a restoring force.
static bool filter_of(const struct spline *spline, struct swing_filter *filter)
{
    double parameter[PARAMETER_COUNT];
    for (int p = 0; p < PARAMETER_COUNT; p++) parameter[p] = spline->parameter[p].value;
    return swing_filter(spline, parameter, filter);
}

/// The push of a held body kicks the reed's own oscillator. Returns whether it still swings.
static bool brush_reed(struct brushed_reed *reed, const double pushed[2], bool held, const step_matrix *m,
                       double natural, double dt)
{
    double left = 0;
    for (int k = 0; k < 2; k++) {
        const double speed = held ? (pushed[k] - reed->pushed[k]) / dt : 0, q = reed->q[k];
        const double v = reed->v[k] - (speed - reed->speed[k]);
        reed->pushed[k] = pushed[k];
        reed->speed[k] = speed;
        reed->q[k] = m->q_q * q + m->q_v * v;
        reed->v[k] = m->v_q * q + m->v_v * v;
        left = fmax(left, fabs(reed->q[k]) + fabs(reed->v[k]) / natural);
    }
    return left > STILL;
}

/// Updates push and swing of all reeds.
static void brush_all(struct stage *stage, const struct core *core, const struct spline *spline, int count)
{
    struct meadow_view *shown = &stage->meadow;
    struct swing_filter filter;
    const bool held = body_is_held(core) && core->drag.moved, moves = filter_of(spline, &filter);
    const bool steps = moves && shown->dt > 0 && (held || shown->swings);
    step_matrix m = {0};
    if (steps) m = oscillator_step(filter.of, shown->dt);
    shown->swings = false;
    for (int r = 0; r < count; r++) {
        struct brushed_reed *reed = &shown->brushed[r];
        double pushed[2];
        push_of(stage, shown->reeds[r].place, pushed);
        if (steps) {
            shown->swings |= brush_reed(reed, pushed, held, &m, filter.natural, shown->dt);
        } else {
            memcpy(reed->pushed, pushed, sizeof pushed);
        }
    }
    shown->dt = 0;
    if (!shown->swings && !held) {
        for (int r = 0; r < count; r++) {
            memset(shown->brushed[r].q, 0, sizeof shown->brushed[r].q);
            memset(shown->brushed[r].v, 0, sizeof shown->brushed[r].v);
            memset(shown->brushed[r].speed, 0, sizeof shown->brushed[r].speed);
        }
    }
}

/// The shadow of all reeds: discs wide enough to merge.
static void add_shadow(struct stage_view *view, const double area[2])
{
    enum { ACROSS = 3, DEEP = 2 };
    const float wide = (float)area[0] / ACROSS, deep = (float)area[1] / DEEP,
                radius = 0.68f * maths_hypotf(wide, deep);
    for (int b = 0; b < ACROSS * DEEP; b++)
        stage_add_blob(view, wide * ((float)(b % ACROSS) - 0.5f * (ACROSS - 1)),
                       deep * ((float)(b / ACROSS) - 0.5f * (DEEP - 1)), radius, SHADOW);
}

static void pose(struct stage *stage, const struct core *core, int rig, int n)
{
    const struct posing posing = stage_posing(core);
    const struct meadow *meadow = models_meadow(core->models);
    const struct meadow_rig *of = &core->document->rigs[rig]->meadow;
    struct meadow_view *shown = &stage->meadow;
    struct stage_meadow *view = &stage->view.meadow;
    struct rig_pose posed;
    if (n > 0 || !rig_pose(&posing, rig, 0, NULL, &posed)) return;
    const int count = meadow_count(meadow);
    for (int r = 0; r < count; r++) {
        const struct reed *reed = meadow_reed(meadow, r);
        const wiggly_value value = meadow_value(meadow, r, core->playback.position);
        const double lag = core->look == LOOK_STIFF ? 0 : ROLL * (double)reed->place[0];
        shown->reeds[r] = (struct stage_reed){.height = reed->height,
                                              .still = (float)value.y,
                                              .re = (float)(maths_cos(lag) * value.re + maths_sin(lag) * value.im),
                                              .im = (float)(maths_cos(lag) * value.im - maths_sin(lag) * value.re),
                                              .turn = reed->turn,
                                              .shade = reed->shade,
                                              .width = WIDTH * (0.5f + 0.5f * reed->height)};
        memcpy(shown->reeds[r].place, reed->place, sizeof reed->place);
    }
    brush_all(stage, core, core->document->splines[of->spline], count);
    for (int r = 0; r < count; r++) {
        for (int k = 0; k < 2; k++)
            shown->reeds[r].pushed[k] = (float)(shown->brushed[r].pushed[k] + shown->brushed[r].q[k]);
    }
    const double lag = core->look == LOOK_STIFF ? 0 : of->lag;
    *view = (struct stage_meadow){
        .reeds = shown->reeds, .count = count, .lag = (float)(DEGREE * lag), .gain = (float)(DEGREE * of->gain)};
    rig_bounds(&posed, view->lo, view->hi);
    add_shadow(&stage->view, of->area);
}

static uint64_t hash(uint64_t sum, const struct stage_view *view)
{
    const struct stage_meadow *meadow = &view->meadow;
    if (meadow->count == 0) return sum;
    sum = hash_bytes(sum, &meadow->lag, 2 * sizeof meadow->lag);
    return hash_bytes(sum, meadow->reeds, (size_t)meadow->count * sizeof *meadow->reeds);
}

const struct stage_kind meadow_stage = {.pose = pose, .bound_steps = 1, .hash = hash};
