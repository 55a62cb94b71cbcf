/// Onion skin: light proxies of the tail (an outline each) or chain (a line each) at the knots around the playhead; and the
/// same at the one knot that is being edited, its ghost.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/stage/overlays.h"
#include "editor/stage/rigs.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"
#include "model/creature.h"
#include "model/vector.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    MAX_SKINS = 8,
    STATIONS = 20,                ///< along the tail
    TIP = 5,                      ///< points round it
    OUTLINE = 2 * STATIONS + TIP, ///< there, round the tip and back
};

static const double FROM = 0.16,
                    TO = 0.985; ///< shares of the length: outside of the body, and where the rounded tip begins
static const float NEAREST = 0.75f, FARTHEST = 0.22f; ///< opacity of the first and of the last skin
static const float GHOST = 0.85f;
static const double FADE = 0.4; ///< seconds in which a nudged knot's ghost goes

int overlay_rig(const struct stage *stage, const struct core *core, const struct document *document)
{
    int rig, channel;
    if (!core_active_channel(core, document, &rig, &channel))
        rig = stage->strand_count > 0 ? stage->strands[0].rig : -1;
    return rig >= 0 && strand_of(stage, rig) ? rig : -1;
}

/// The spline whose knots are shown: the active one, or where it has none, the one that it swings about.
static const struct spline *keyed_spline(const struct core *core, const struct editor_world *world)
{
    const struct spline *spline = core_active_spline(core, world);
    if (!spline || spline->knot_count > 0) return spline;
    int track = spline->parameter[PARAMETER_EQUILIBRIUM].track;
    return track >= 0 ? &world->document->splines[track] : spline;
}

/// Samples of the knots nearest to a position, the nearest first; returns how many.
static int nearest_knots(const struct document *document, const struct spline *spline, double position,
                         int samples[MAX_SKINS])
{
    int after = spline_lower_bound(document, spline, (int)ceil(position)), before = after - 1, count = 0;
    while (count < MAX_SKINS && (before >= 0 || after < spline->knot_count)) {
        int low = before >= 0 ? document_sample(document, spline->knots[before].frame) : 0;
        int high = after < spline->knot_count ? document_sample(document, spline->knots[after].frame) : 0;
        bool back = after == spline->knot_count || (before >= 0 && position - low <= high - position);
        samples[count++] = back ? low : high;
        if (back) {
            before--;
        } else {
            after++;
        }
    }
    return count;
}

/// A point of the centre line at a share of the length, and the pixels that the tail is thick there to each side.
static bool station(const struct stage *stage, const struct core *core, const struct pose *pose, double share,
                    float xy[2], float *radius)
{
    const struct stage_view *view = &stage->view;
    double at = share * (pose->count - 1);
    int joint = at >= pose->count - 1 ? pose->count - 2 : (int)at;
    const vec3s from = vec3_from(pose->matrix[joint] + 12), to = vec3_from(pose->matrix[joint + 1] + 12);
    const vec3s point = glms_vec3_lerp(from, to, (float)(at - joint));
    if (!stage_project_point(stage, core->layout.stage, point.raw, xy)) return false;
    const float depth = camera_depth(view->view, view->eye, pose->matrix[joint] + 12);
    float metres =
        creature_tail_radius((float)share * CREATURE_TAIL_LENGTH) * pose_length(pose) / CREATURE_TAIL_LENGTH;
    *radius = metres * 0.5f * view->viewport.h * view->projection[5] / fmaxf(depth, 0.1f);
    return true;
}

/// The outline of a tail on the screen, open where it grows out of the body; false where a part of it is behind the eye.
static bool outline(const struct stage *stage, const struct core *core, const struct pose *pose,
                    float out[OUTLINE][2])
{
    float middle[STATIONS][2], radius[STATIONS], across[2] = {0, 0};
    for (int i = 0; i < STATIONS; i++) {
        if (!station(stage, core, pose, FROM + (TO - FROM) * i / (STATIONS - 1), middle[i], &radius[i])) return false;
    }
    for (int i = 0; i < STATIONS; i++) {
        const float *from = middle[i > 0 ? i - 1 : 0], *to = middle[i + 1 < STATIONS ? i + 1 : i];
        float dx = to[0] - from[0], dy = to[1] - from[1], length = hypotf(dx, dy);
        if (length > 0.01f) across[0] = -dy / length, across[1] = dx / length;
        for (int k = 0; k < 2; k++) {
            out[i][k] = middle[i][k] + radius[i] * across[k];
            out[2 * STATIONS + TIP - 1 - i][k] = middle[i][k] - radius[i] * across[k];
        }
    }
    for (int i = 0; i < TIP; i++) { // half a turn round the tip
        float angle = 3.14159265f * (float)(i + 1) / (TIP + 1), c = cosf(angle), s = sinf(angle);
        out[STATIONS + i][0] = middle[STATIONS - 1][0] + radius[STATIONS - 1] * (c * across[0] + s * across[1]);
        out[STATIONS + i][1] = middle[STATIONS - 1][1] + radius[STATIONS - 1] * (c * across[1] - s * across[0]);
    }
    return true;
}

/// The outline of a tail, the line of a chain's bones; how many points, 0 where a part is behind the eye.
static int lay_out(const struct stage *stage, const struct core *core, const struct rig_pose *pose, float points[][2])
{
    if (pose->kind == RIG_TAIL) return outline(stage, core, &pose->tail, points) ? OUTLINE : 0;
    for (int n = 0; n < pose->chain.count; n++) {
        if (!stage_project_point(stage, core->layout.stage, pose->chain.point[n], points[n])) return 0;
    }
    return pose->chain.count;
}

/// Draws the rig as it is on a sample; where the end of its tip is on the screen. false where it cannot be seen.
static bool show_skin(const struct stage *stage, struct core *core, const struct posing *posing, int rig, int sample,
                      float width, uint32_t color, float tip[2])
{
    struct rig_pose pose;
    float points[OUTLINE + ANGLES_MAX_JOINTS][2];
    if (!rig_pose(posing, rig, sample, NULL, &pose)) return false;
    const int length = lay_out(stage, core, &pose, points);
    if (length == 0) return false;
    drawlist_line(&core->list, points[0], length, width, color);
    const float *end = points[pose.kind == RIG_TAIL ? STATIONS + TIP / 2 : length - 1];
    tip[0] = end[0];
    tip[1] = end[1];
    return true;
}

void onion_show(const struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct spline *spline = keyed_spline(core, world);
    int rig = overlay_rig(stage, core, document), samples[MAX_SKINS];
    if (!core->overlays.onion || !spline || rig < 0) return;
    int count = nearest_knots(document, spline, core->playback.position, samples);
    uint32_t color = arrange_color(document, core->active);
    const struct posing posing = stage_posing(core, world);
    for (int i = count - 1; i >= 0; i--) {
        float share = count > 1 ? (float)i / (float)(count - 1) : 0, tip[2];
        show_skin(stage, core, &posing, rig, samples[i], 1.25f,
                  theme_fade(color, NEAREST + (FARTHEST - NEAREST) * share), tip);
    }
}

/// The knot of the active spline that is being edited: held by the pointer, or the only one that is selected, just nudged.
static const struct knot *edited_knot(const struct core *core, const struct editor_world *world)
{
    const struct drag *drag = &core->drag;
    const struct spline *spline = core_active_spline(core, world);
    int at = -1;
    if (spline && drag->knot && drag->kind != DRAG_NONE && drag->moved) at = spline_find_id(spline, drag->knot);
    if (spline && drag->kind == DRAG_NONE && core->nudged_seconds > 0)
        at = selection_single(&core->selection, spline);
    return at >= 0 ? &spline->knots[at] : NULL;
}

void ghost_show(const struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct knot *knot = core->overlays.ghost ? edited_knot(core, world) : NULL;
    const int rig = overlay_rig(stage, core, document);
    if (!knot || rig < 0) return;
    const int sample = document_sample(document, knot->frame);
    if (fabs(sample - core->playback.position) < 0.5) return;
    const struct posing posing = stage_posing(core, world);
    const double left = core->drag.kind == DRAG_NONE ? fmin(core->nudged_seconds / FADE, 1) : 1;
    const uint32_t color = theme_fade(arrange_color(document, core->active), GHOST * (float)left);
    float tip[2];
    if (!show_skin(stage, core, &posing, rig, sample, 1.5f, color, tip)) return;
    char text[32];
    snprintf(text, sizeof text, "%.4g", knot->frame);
    drawlist_text(&core->list, roundf(tip[0] + 8), roundf(tip[1] + 4), FONT_NUMBER, THEME_TEXT_SMALL,
                  theme_fade(theme()->text_dim, (float)left), text);
}

void stage_toggle_ghost(struct core *core)
{
    core->overlays.ghost = !core->overlays.ghost;
    core_message(core, false,
                 core->overlays.ghost ? "Ghost on: the pose at the knot that is dragged or nudged (F4)."
                                      : "Ghost off.");
}

void stage_toggle_onion(struct core *core)
{
    core->overlays.onion = !core->overlays.onion;
    core_message(core, false,
                 core->overlays.onion ? "Onion skin on: the tail at the knots around the playhead (O)."
                                      : "Onion skin off.");
}
