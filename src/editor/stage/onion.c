/// Onion skin: outlines of a rig at knots near the playhead, and a ghost at the knot being edited.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/stage/parts.h"
#include "maths/maths.h"
#include "model/figure.h"
#include "model/fox.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    MAX_SKINS = 8,
    CHARACTER_SKINS = 4, ///< each is a surface to pose, and the outlines overlap
};

static const float NEAREST = 0.75f, FARTHEST = 0.22f; ///< opacity of the first and last skin
static const float GHOST = 0.85f;
static const double FADE = 0.4; ///< seconds in which a nudged knot's ghost fades

int overlay_rig(const struct stage *stage, const struct core *core)
{
    int rig, channel;
    if (!core_active_channel(core, &rig, &channel)) rig = stage->strand_count > 0 ? stage->strands[0].rig : -1;
    return rig >= 0 && strand_of(stage, rig) ? rig : -1;
}

/// The character that the active spline moves, else the tail or chain, else the first character; or -1.
static int overlay_pose_rig(const struct stage *stage, const struct core *core)
{
    const struct document *document = core->document;
    const int first = document_next_rig(document, RIG_CHARACTER, -1);
    for (int r = first; r >= 0; r = document_next_rig(document, RIG_CHARACTER, r)) {
        const struct rig *rig = document->rigs[r];
        for (int i = 0; i < rig_input_count(rig); i++) {
            if (rig_input(rig, i) == core->active) return r;
        }
    }
    const int strand = overlay_rig(stage, core);
    return strand >= 0 ? strand : first;
}

/// The spline whose knots are shown: the active one, or if it has none, its equilibrium's.
static const struct spline *keyed_spline(const struct core *core)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || spline->knot_count > 0) return spline;
    int track = spline->parameter[PARAMETER_EQUILIBRIUM].track;
    return track >= 0 ? core->document->splines[track] : spline;
}

/// Samples of the knots nearest to a position, nearest first; returns their number.
static int nearest_knots(const struct document *document, const struct spline *spline, double position,
                         int samples[MAX_SKINS], int most)
{
    int after = spline_lower_bound(document, spline, (int)ceil(position)), before = after - 1, count = 0;
    while (count < most && (before >= 0 || after < spline->knot_count)) {
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

enum { STATIONS = 48 }; ///< along the tail

static const double FROM = 0.16,
                    TO = 0.985; ///< shares of the length: outside the body, and up to the rounded tip
static const float OPEN = 1.5f; ///< cells from the root's disc; closer parts of a tail's outline are not drawn

/// A disc of a tail, on the screen.
struct disc {
    float middle[2], radius;
};

/// The tail's disc at a share of its length; false if behind the eye.
static bool station(const struct stage *stage, const struct core *core, const struct pose *pose, double share,
                    struct disc *disc)
{
    const struct stage_view *view = &stage->view;
    double at = share * (pose->count - 1);
    int joint = at >= pose->count - 1 ? pose->count - 2 : (int)at;
    const vec3s from = vec3_from(pose->matrix[joint] + 12), to = vec3_from(pose->matrix[joint + 1] + 12);
    const vec3s point = glms_vec3_lerp(from, to, (float)(at - joint));
    if (!stage_project_point(stage, core->layout.stage, point.raw, disc->middle)) return false;
    const float depth = camera_depth(view->view, view->eye, pose->matrix[joint] + 12);
    float metres = fox_tail_radius((float)share * FOX_TAIL_LENGTH) * pose->scale;
    disc->radius = metres * 0.5f * view->viewport.h * view->projection[5] / fmaxf(depth, 0.1f);
    return true;
}

/// Draws an outline without its longest part at the root, where the tail joins the body.
static void show_open(struct stage *stage, struct core *core, int count, const struct disc *root, float width,
                      uint32_t color)
{
    float(*points)[2] = stage->silhouette.points;
    const float reach = root->radius + OPEN * stage->silhouette.cell;
    const int whole = count - 1; // the last point repeats the first
    int longest = 0, start = 0, run = 0;
    memcpy(points[whole], points[0], (size_t)whole * sizeof points[0]);
    for (int i = 0; i < 2 * whole; i++) {
        run = maths_hypotf(points[i][0] - root->middle[0], points[i][1] - root->middle[1]) < reach ? run + 1 : 0;
        if (run > longest && run < whole) longest = run, start = (i + 1) % whole;
    }
    drawlist_line(&core->list, points[start], longest > 0 ? whole - longest : count, width, color);
}

static bool show_tail(struct stage *stage, struct core *core, const struct pose *pose, float width, uint32_t color,
                      float tip[2])
{
    struct disc discs[STATIONS];
    struct silhouette *silhouette = &stage->silhouette;
    silhouette_clear(silhouette);
    for (int i = 0; i < STATIONS; i++) {
        if (!station(stage, core, pose, FROM + (TO - FROM) * i / (STATIONS - 1), &discs[i])) return false;
        silhouette_widen(silhouette, discs[i].middle, discs[i].radius);
    }
    if (!silhouette_open(silhouette, core->layout.stage)) return false;
    for (int i = 1; i < STATIONS; i++)
        silhouette_add_link(silhouette, discs[i - 1].middle, discs[i - 1].radius, discs[i].middle, discs[i].radius);
    const int count = silhouette_follow(silhouette);
    if (count > 0) show_open(stage, core, count, &discs[0], width, color);
    const struct disc *last = &discs[STATIONS - 1], *before = &discs[STATIONS - 3];
    const float dx = last->middle[0] - before->middle[0], dy = last->middle[1] - before->middle[1];
    const float share = last->radius / fmaxf(maths_hypotf(dx, dy), 1);
    tip[0] = last->middle[0] + share * dx;
    tip[1] = last->middle[1] + share * dy;
    return true;
}

static bool show_chain(struct stage *stage, struct core *core, const struct pose *pose, float width, uint32_t color,
                       float tip[2])
{
    float points[ANGLES_MAX_JOINTS + 1][2];
    for (int n = 0; n < pose->count; n++) {
        if (!stage_project_point(stage, core->layout.stage, pose->matrix[n] + 12, points[n])) return false;
    }
    if (pose->count == 0) return false;
    drawlist_line(&core->list, points[0], pose->count, width, color);
    memcpy(tip, points[pose->count - 1], 2 * sizeof *tip);
    return true;
}

/// Poses its surface in hover's skin and projects it to the screen; hover will pose the skin again.
static bool project_surface(struct stage *stage, const struct core *core, const struct figure *figure,
                            const struct morph *morph, const float position[3])
{
    float(*posed)[3] = stage->skin.posed;
    if (figure->character.vertex_count > stage->skin.capacity) return false;
    stage->skin.hash = 0;
    silhouette_clear(&stage->silhouette);
    morph_places(figure, morph, position, posed);
    for (int i = 0; i < figure->character.vertex_count; i++) {
        float xy[2];
        if (!stage_project_point(stage, core->layout.stage, posed[i], xy)) return false;
        memcpy(posed[i], xy, sizeof xy);
        silhouette_widen(&stage->silhouette, xy, 0);
    }
    return true;
}

static bool show_character(struct stage *stage, struct core *core, const struct rig_pose *pose, int character,
                           float width, uint32_t color, float tip[2])
{
    const struct figure *figure = pose->character.figure;
    const struct stage_character *shown = stage_character_shown(stage, character);
    struct silhouette *silhouette = &stage->silhouette;
    if (!shown || !project_surface(stage, core, figure, &pose->character.morph, shown->position) ||
        !silhouette_open(silhouette, core->layout.stage))
        return false;
    const float all[3] = {1e6f, 1e6f, 1e6f};
    for (int t = 0; t < figure->character.index_count; t += 3) {
        float corner[3][2];
        for (int k = 0; k < 3; k++)
            memcpy(corner[k], stage->skin.posed[figure->character.indices[t + k]], sizeof corner[k]);
        silhouette_add_triangle(silhouette, (const float(*)[2])corner, all);
    }
    silhouette_soften(silhouette);
    for (int count; (count = silhouette_follow(silhouette)) > 0;)
        drawlist_line(&core->list, silhouette->points[0], count, width, color);
    const float *low = silhouette->low, *high = silhouette->high;
    tip[0] = fminf(high[0], core->layout.stage.x + 0.9f * core->layout.stage.w);
    tip[1] = fmaxf(0.7f * low[1] + 0.3f * high[1], core->layout.stage.y + 20);
    return true;
}

/// Outlines a rig at a sample; `tip` receives a place for text. False if not visible.
static bool proxy_show(struct stage *stage, struct core *core, const struct posing *posing, int rig, int sample,
                       float width, uint32_t color, float tip[2])
{
    struct rig_pose pose;
    if (!rig_pose(posing, rig, sample, NULL, &pose)) return false;
    switch (pose.kind) {
    case RIG_TAIL:
        return show_tail(stage, core, &pose.strand, width, color, tip);
    case RIG_CHAIN:
        return show_chain(stage, core, &pose.strand, width, color, tip);
    case RIG_CHARACTER:
        return show_character(stage, core, &pose, document_rig_number(posing->document, rig), width, color, tip);
    default:
        return false;
    }
}

void onion_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    const struct spline *spline = keyed_spline(core);
    const int rig = overlay_pose_rig(stage, core);
    int samples[MAX_SKINS];
    if (!core->overlays.onion || !spline || rig < 0) return;
    const int most = document->rigs[rig]->kind == RIG_CHARACTER ? CHARACTER_SKINS : MAX_SKINS;
    const int count = nearest_knots(document, spline, core->playback.position, samples, most);
    uint32_t color = spline_list_color(document, core->active);
    const struct posing posing = stage_posing(core);
    for (int i = count - 1; i >= 0; i--) {
        float share = count > 1 ? (float)i / (float)(count - 1) : 0, tip[2];
        proxy_show(stage, core, &posing, rig, samples[i], 1.25f,
                   theme_fade(color, NEAREST + (FARTHEST - NEAREST) * share), tip);
    }
}

/// The active spline's knot being edited: held by the pointer, or the only selected one after a nudge.
static const struct knot *edited_knot(const struct core *core)
{
    const struct drag *drag = &core->drag;
    const struct spline *spline = core_active_spline(core);
    int at = -1;
    if (spline && drag->owner && drag->knot && drag->moved) at = spline_find_id(spline, drag->knot);
    if (spline && !drag->owner && core->nudged_seconds > 0) at = selection_single(&core->selection, spline);
    return at >= 0 ? &spline->knots[at] : NULL;
}

void ghost_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    const struct knot *knot = core->overlays.ghost ? edited_knot(core) : NULL;
    const int rig = knot ? overlay_pose_rig(stage, core) : -1;
    if (rig < 0) return;
    const int sample = document_sample(document, knot->frame);
    if (fabs(sample - core->playback.position) < 0.5) return;
    const struct posing posing = stage_posing(core);
    const double left = !core->drag.owner ? fmin(core->nudged_seconds / FADE, 1) : 1;
    const uint32_t color = theme_fade(spline_list_color(document, core->active), GHOST * (float)left);
    float tip[2];
    if (!proxy_show(stage, core, &posing, rig, sample, 1.5f, color, tip)) return;
    char text[32];
    snprintf(text, sizeof text, "%.4g", knot->frame);
    stage_note(core, roundf(tip[0] + 8), roundf(tip[1] + 4), FONT_NUMBER, theme()->text_dim, text);
}
