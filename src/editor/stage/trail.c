/// Motion arcs: the path of a tip, a character's vertex or a held point, with one mark per frame, fading away from the playhead.
#include "base/hash.h"
#include "editor/core/bones.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>

enum {
    MAX_REACH = TRAIL_FRAMES / 2 - 1, ///< frames to each side
    PIECES = 3,                       ///< straight pieces per frame
    RUN = 4,                          ///< frames of equal opacity
};

static const double REACH = 2;                            ///< seconds to each side
static const float OPACITY = 0.85f, MARK = 2.5f, NOW = 5; ///< mark radii in pixels; NOW: at the playhead

/// Searches all vertices once per figure and version.
static int liveliest_vertex(struct liveliest *known, const struct figure *figure)
{
    const struct character *character = &figure->character;
    if (known->figure == figure->id && known->version == figure->version) return known->vertex;
    float most = -1;
    int found = 0;
    for (int i = 0; i < character->vertex_count; i++) {
        float way = 0;
        for (int k = 0; k < character->coordinate_count; k++) {
            const struct coordinate *c = &character->coordinates[k];
            way += glms_vec3_norm2(vec3_from(c->re[i])) + glms_vec3_norm2(vec3_from(c->im[i]));
        }
        if (way > most) found = i;
        most = fmaxf(most, way);
    }
    *known = (struct liveliest){figure->id, figure->version, found};
    return found;
}

struct rig_point overlay_point(struct stage *stage, const struct core *core)
{
    const int rig = overlay_rig(stage, core);
    if (rig >= 0) return (struct rig_point){rig, bones_joints(core, rig) - 1};
    const int n = core->characters.character;
    const struct figure *figure = models_figure(core->models, n);
    if (!figure) return (struct rig_point){-1, -1};
    return (struct rig_point){document_find_rig(core->document, RIG_CHARACTER, n),
                              liveliest_vertex(&stage->liveliest, figure)};
}

static bool loops(const struct document *document, int spline)
{
    return spline < 0 || spline_start(document->splines[spline]) == WIGGLY_LOOP;
}

/// Whether frames beyond the range repeat, because everything that moves the rig loops. A chain's clip repeats anyway.
static bool rig_loops(const struct document *document, const struct rig *rig)
{
    bool all = rig_input_count(rig) > 0;
    for (int i = 0; i < rig_input_count(rig); i++) all &= loops(document, rig_input(rig, i));
    for (int k = 0; k < 3 && rig->kind == RIG_TAIL; k++) all &= loops(document, rig->tail.position[k].track);
    return all;
}

/// The point's world place at a frame counted from the first, cached until an edit.
static const float *place_at(struct trail_point *trail, const struct core *core, struct rig_point point, int frame)
{
    uint64_t solved = core->evaluation ? core->evaluation->revision : 0;
    uint64_t key = hash_word(hash_word(HASH_START, history_revision(core->history)), solved);
    key = hash_word(hash_word(key, (uint64_t)point.rig << 8 | (uint64_t)core->look), (uint64_t)point.at);
    struct trail_point *kept = &trail[(frame % TRAIL_FRAMES + TRAIL_FRAMES) % TRAIL_FRAMES];
    if (kept->known && kept->key == key && kept->frame == frame) return kept->place;
    *kept = (struct trail_point){.known = true, .key = key, .frame = frame};
    point_place(core, point, (double)frame * core->document->substeps, kept->place);
    return kept->place;
}

/// Catmull-Rom interpolation on the screen.
static void between(const float a[2], const float b[2], const float c[2], const float d[2], float u, float out[2])
{
    for (int k = 0; k < 2; k++) {
        float m0 = 0.5f * (c[k] - a[k]), m1 = 0.5f * (d[k] - b[k]), step = c[k] - b[k];
        out[k] = b[k] + u * (m0 + u * (3 * step - 2 * m0 - m1 + u * (m0 + m1 - 2 * step)));
    }
}

/// Projects frames first … last, each followed by PIECES − 1 points; returns the number of points.
static int lay_out(float screen[TRAIL_FRAMES][2], int count, float points[][2])
{
    int made = 0;
    for (int i = 0; i + 1 < count; i++) {
        const float *a = screen[i > 0 ? i - 1 : i], *d = screen[i + 2 < count ? i + 2 : i + 1];
        for (int p = 0; p < PIECES; p++) {
            between(a, screen[i], screen[i + 1], d, (float)p / PIECES, points[made++]);
        }
    }
    points[made][0] = screen[count - 1][0];
    points[made][1] = screen[count - 1][1];
    return made + 1;
}

static float fade_at(double frames, double reach) { return OPACITY * fmaxf(0, 1 - (float)(fabs(frames) / reach)); }

static void show_marks(struct core *core, float screen[TRAIL_FRAMES][2], int first, int count, double now,
                       double reach)
{
    for (int i = 0; i < count; i++) {
        float alpha = fade_at(first + i - now, reach);
        struct rect mark = {screen[i][0] - MARK / 2, screen[i][1] - MARK / 2, MARK, MARK};
        if (alpha > 0.02f) drawlist_rect(&core->list, mark, theme_fade(theme()->playhead, alpha));
    }
}

static void show_line(struct core *core, float points[][2], int first, int count, double now, double reach)
{
    for (int i = 0; i + 1 < count; i += RUN * PIECES) {
        int length = count - i < RUN * PIECES + 1 ? count - i : RUN * PIECES + 1;
        float alpha = fade_at(first + (i + length / 2.0) / PIECES - now, reach);
        if (alpha > 0.02f)
            drawlist_line(&core->list, points[i], length, 1.5f, theme_fade(theme()->playhead, 0.7f * alpha));
    }
}

/// Where the point is shown now: a tip follows a dragged body.
static bool project_now(struct stage *stage, const struct core *core, struct rig_point point, float xy[2])
{
    float place[3];
    if (strand_of(stage, point.rig)) return stage_project(stage, core, point.rig, point.at + 1, 0, xy);
    return point_place(core, point, core->playback.position, place) &&
           stage_project_point(stage, core->layout.stage, place, xy);
}

/// A ring around the point's current place.
static void show_now(struct stage *stage, struct core *core, struct rig_point point)
{
    float xy[2];
    if (!project_now(stage, core, point, xy)) return;
    drawlist_circle(&core->list, xy, NOW, 1.5f, theme()->playhead);
}

void path_show(struct stage *stage, struct core *core, enum trail which, struct rig_point point)
{
    const struct document *document = core->document;
    double now = core->playback.position / document->substeps;
    double reach = fmin(fmax(REACH * document->fps, 1), MAX_REACH);
    int first = (int)ceil(now - reach), last = (int)floor(now + reach);
    if (!rig_loops(document, document->rigs[point.rig])) {
        first = first < 0 ? 0 : first;
        last =
            last < document->last_frame - document->first_frame ? last : document->last_frame - document->first_frame;
    }
    float screen[TRAIL_FRAMES][2], points[PIECES * TRAIL_FRAMES][2];
    int count = 0;
    for (int frame = first; frame <= last; frame++) {
        const float *place = place_at(stage->trail[which], core, point, frame);
        if (!stage_project_point(stage, core->layout.stage, place, screen[count++])) return;
    }
    if (count == 0) return;
    show_line(core, points, first, lay_out(screen, count, points), now, reach);
    show_marks(core, screen, first, count, now, reach);
}

void trail_show(struct stage *stage, struct core *core)
{
    if (!core->overlays.trail) return;
    const struct rig_point point = overlay_point(stage, core);
    if (!point_exists(core, point)) return;
    path_show(stage, core, TRAIL_OF_TIP, point);
    show_now(stage, core, point);
}
