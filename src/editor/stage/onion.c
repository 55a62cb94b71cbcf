/// Onion skin: proxies of a rig at the knots around the playhead; and at the one knot that is being edited, its ghost.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/stage/overlays.h"
#include "editor/stage/proxy.h"
#include "editor/stage/rigs.h"
#include "editor/stage/stage.h"
#include "editor/stage/strand.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    MAX_SKINS = 8,
    CHARACTER_SKINS = 4, ///< their outlines lie over each other, and each is a surface to pose
};

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

int overlay_pose_rig(const struct stage *stage, const struct core *core, const struct document *document)
{
    const int first = document_next_rig(document, RIG_CHARACTER, 0);
    for (int r = first; r >= 0; r = document_next_rig(document, RIG_CHARACTER, r + 1)) {
        const struct rig *rig = &document->rigs[r];
        for (int i = 0; i < rig_input_count(rig); i++) {
            if (rig_input(rig, i) == core->active) return r;
        }
    }
    const int strand = overlay_rig(stage, core, document);
    return strand >= 0 ? strand : first;
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

void onion_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct spline *spline = keyed_spline(core, world);
    const int rig = overlay_pose_rig(stage, core, document);
    int samples[MAX_SKINS];
    if (!core->overlays.onion || !spline || rig < 0) return;
    const int most = document->rigs[rig].kind == RIG_CHARACTER ? CHARACTER_SKINS : MAX_SKINS;
    const int count = nearest_knots(document, spline, core->playback.position, samples, most);
    uint32_t color = arrange_color(document, core->active);
    const struct posing posing = stage_posing(core, world);
    for (int i = count - 1; i >= 0; i--) {
        float share = count > 1 ? (float)i / (float)(count - 1) : 0, tip[2];
        proxy_show(stage, core, &posing, rig, samples[i], 1.25f,
                   theme_fade(color, NEAREST + (FARTHEST - NEAREST) * share), tip);
    }
}

/// The knot of the active spline that is being edited: held by the pointer, or the only one that is selected, just nudged.
static const struct knot *edited_knot(const struct core *core, const struct editor_world *world)
{
    const struct drag *drag = &core->drag;
    const struct spline *spline = core_active_spline(core, world);
    int at = -1;
    if (spline && drag->owner && drag->knot && drag->moved) at = spline_find_id(spline, drag->knot);
    if (spline && !drag->owner && core->nudged_seconds > 0) at = selection_single(&core->selection, spline);
    return at >= 0 ? &spline->knots[at] : NULL;
}

void ghost_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct knot *knot = core->overlays.ghost ? edited_knot(core, world) : NULL;
    const int rig = knot ? overlay_pose_rig(stage, core, document) : -1;
    if (rig < 0) return;
    const int sample = document_sample(document, knot->frame);
    if (fabs(sample - core->playback.position) < 0.5) return;
    const struct posing posing = stage_posing(core, world);
    const double left = !core->drag.owner ? fmin(core->nudged_seconds / FADE, 1) : 1;
    const uint32_t color = theme_fade(arrange_color(document, core->active), GHOST * (float)left);
    float tip[2];
    if (!proxy_show(stage, core, &posing, rig, sample, 1.5f, color, tip)) return;
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
                 core->overlays.onion ? "Onion skin on: the pose at the knots around the playhead (O)."
                                      : "Onion skin off.");
}
