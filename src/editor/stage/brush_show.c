/// The ring of the brush: where the distance over the surface from the spot under the pointer is the radius, drawn triangle
/// by triangle, so that it lies on the posed surface as the paint will.
#include "base/printable.h"
#include "editor/core/characters.h"
#include "editor/stage/brush.h"
#include "editor/stage/overlays.h"
#include "editor/stage/rigs.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PIECES = 512, SMOOTHINGS = 3, STATE_HEIGHT = 46 };

static const double DEGREES = 57.29577951308232;

static const float RING_WIDTH = 1.5f, SHADE_WIDTH = 3.5f;
static const uint32_t RING = 0xFFFFFFFFu, SHADE = 0x00000060u; ///< on the colours of the map, in any theme
static const float CLOSE = 2;                                  ///< pixels: points nearer to the last one are left out

/// Pieces of the ring on the screen: two points each, which neighbours share exactly.
struct ring {
    float xy[MOST_PIECES][2][2];
    int count;
};

/// Where the distance passes `radius` on the side between two corners: the same for both triangles at it, to the last bit.
static bool crosses(const struct stage *stage, uint32_t one, uint32_t other, float radius, float point[3])
{
    const uint32_t a = one < other ? one : other, b = one < other ? other : one;
    const float *distance = stage->painting.work.reach.distance, from = distance[a], to = distance[b];
    if ((from < radius) == (to < radius) || !(from < INFINITY) || !(to < INFINITY)) return false;
    const float share = (radius - from) / (to - from);
    glm_vec3_lerp(stage->skin.posed[a], stage->skin.posed[b], share, point);
    return true;
}

static bool faces_eye(const struct stage *stage, const uint32_t *corner)
{
    float xy[3][2];
    for (int c = 0; c < 3; c++) {
        if (!stage_project_point(stage, stage->view.viewport, stage->skin.posed[corner[c]], xy[c])) return false;
    }
    return (xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) < (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]);
}

static void add_piece(struct stage *stage, const uint32_t *corner, float radius, struct ring *ring)
{
    float ends[3][3];
    int count = 0;
    if (ring->count == MOST_PIECES) return;
    for (int c = 0; c < 3; c++) count += crosses(stage, corner[c], corner[(c + 1) % 3], radius, ends[count]);
    if (count != 2 || !faces_eye(stage, corner)) return;
    float(*piece)[2] = ring->xy[ring->count];
    ring->count += stage_project_point(stage, stage->view.viewport, ends[0], piece[0]) &&
                   stage_project_point(stage, stage->view.viewport, ends[1], piece[1]);
}

static bool is_same(const float a[2], const float b[2]) { return a[0] == b[0] && a[1] == b[1]; }

/// Takes a piece that begins or ends at a point out of the ring, and moves the point to its other end.
static bool take_piece(struct ring *ring, float at[2])
{
    for (int i = 0; i < ring->count; i++) {
        for (int end = 0; end < 2; end++) {
            if (!is_same(ring->xy[i][end], at)) continue;
            memcpy(at, ring->xy[i][1 - end], sizeof ring->xy[i][0]);
            memcpy(ring->xy[i], ring->xy[--ring->count], sizeof ring->xy[i]);
            return true;
        }
    }
    return false;
}

/// Follows a line from one of its ends as far as it goes.
static int extend(struct ring *ring, const float from[2], float (*line)[2], int count)
{
    float at[2] = {from[0], from[1]};
    while (take_piece(ring, at)) {
        const bool is_last = ring->count == 0;
        if (!is_last && hypotf(at[0] - line[count - 1][0], at[1] - line[count - 1][1]) < CLOSE) continue;
        memcpy(line[count++], at, sizeof at);
    }
    return count;
}

/// Takes a piece and all that go on from it out of the ring, as one line: from the piece's first end backwards, turned round, and
/// then from its second end on.
static int take_line(struct ring *ring, float (*line)[2])
{
    float first[2][2];
    memcpy(first, ring->xy[--ring->count], sizeof first);
    memcpy(line[0], first[0], sizeof first[0]);
    int count = extend(ring, first[0], line, 1);
    for (int i = 0; i < count / 2; i++) {
        float other[2];
        memcpy(other, line[i], sizeof other);
        memcpy(line[i], line[count - 1 - i], sizeof other);
        memcpy(line[count - 1 - i], other, sizeof other);
    }
    memcpy(line[count++], first[1], sizeof first[1]);
    return extend(ring, first[1], line, count);
}

/// Evens out the zigzag of ways along edges: each point goes halfway to the middle of its neighbours, ends of an open line stay.
static void smooth_line(float (*line)[2], int count)
{
    const bool closed = is_same(line[0], line[count - 1]);
    for (int k = 0; k < 2 && count > 2; k++) {
        float before = line[closed ? count - 2 : 0][k];
        for (int i = closed ? 0 : 1; i < count - 1; i++) {
            const float own = line[i][k];
            line[i][k] = 0.5f * own + 0.25f * (before + line[i + 1][k]);
            before = own;
        }
        if (closed) line[count - 1][k] = line[0][k];
    }
}

static void show_ring(struct stage *stage, struct core *core, const struct figure *figure)
{
    struct ring ring;
    ring.count = 0;
    const float radius = brush_radius_of(&core->brush, figure);
    for (int t = 0; t < figure->character.index_count; t += 3)
        add_piece(stage, figure->character.indices + t, radius, &ring);
    while (ring.count > 0) {
        float line[2 * MOST_PIECES + 2][2];
        const int count = take_line(&ring, line);
        for (int pass = 0; pass < SMOOTHINGS; pass++) smooth_line(line, count);
        drawlist_line(&core->list, line[0], count, SHADE_WIDTH, SHADE);
        drawlist_line(&core->list, line[0], count, RING_WIDTH, RING);
    }
}

/// What is painted at the vertex nearest to the pointer; leaves the text alone where that is nothing.
static void describe_spot(const struct stage *stage, const struct paint *paint, int coordinate, char *text,
                          size_t size)
{
    const struct surface_spot *spot = &stage->painting.spot;
    int nearest = 0;
    for (int c = 1; c < 3; c++) {
        if (spot->weight[c] > spot->weight[nearest]) nearest = c;
    }
    const float *value = paint->values[(size_t)coordinate * (size_t)paint->vertices + spot->corner[nearest]];
    if (value[0] == 0 && value[1] == 0) return;
    snprintf(text, size, "painted here: %+.0f°, × %.2f", printable_number((double)value[1] * DEGREES, 1),
             exp((double)value[0]));
}

static void show_state(const struct stage *stage, struct core *core, const struct paint *paint, int coordinate)
{
    const struct brush *brush = &core->brush;
    const struct painting *painting = &stage->painting;
    const struct rect legend = characters_legend(core);
    const struct rect box = {legend.x, legend.y - STATE_HEIGHT - 8, legend.w, STATE_HEIGHT};
    const bool paints = brush_paints(core);
    const char *label = brush_label(paints ? painting->stroke : brush_stroke(brush, core->mods));
    char text[64] = "nothing painted here";
    if (painting->covers && paint) describe_spot(stage, paint, coordinate, text, sizeof text);
    if (!painting->covers)
        snprintf(text, sizeof text, "radius %.0f %%, strength %.0f %%", 100 * brush->radius, 100 * brush->strength);
    drawlist_rounded(&core->list, box, 6, (theme()->panel & 0xFFFFFF00u) | 0xD8u);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 18, box.w - 20, FONT_LABEL_BOLD, THEME_TEXT_SMALL,
                      theme()->text, label);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 35, box.w - 20, FONT_LABEL, THEME_TEXT_SMALL,
                      theme()->text_dim, text);
}

void brush_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    int coordinate;
    const struct figure *figure = core->brush.on ? characters_figure(core, world, &coordinate) : NULL;
    if (!figure) return;
    const struct paint *paint = characters_selected(core, world)->painted;
    if (stage->painting.covers) show_ring(stage, core, figure);
    show_state(stage, core, paint && models_paint_fits(paint, figure) ? paint : NULL, coordinate);
}
