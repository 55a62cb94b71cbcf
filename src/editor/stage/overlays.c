/// What is drawn over the stage to show a motion: onion skins, arcs and pins, and the dragging of these.
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "model/figure.h"
#include "model/fox.h"
#include "model/vector.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

// Outlines by marching squares: an edge lies between an inside and an outside node, where the field crosses 0.

enum { LEAST_POINTS = 12 }; ///< smaller outlines are specks

static const float FINEST = 2;   ///< pixels between nodes
static const float AROUND = 8;   ///< pixels beside the stage, so that cut outlines end out of sight
static const float OUTSIDE = -2; ///< cells; smaller values make no difference

void silhouette_clear(struct silhouette *silhouette)
{
    silhouette->low[0] = silhouette->low[1] = INFINITY;
    silhouette->high[0] = silhouette->high[1] = -INFINITY;
}

void silhouette_widen(struct silhouette *silhouette, const float middle[2], float radius)
{
    for (int k = 0; k < 2; k++) {
        silhouette->low[k] = fminf(silhouette->low[k], middle[k] - radius);
        silhouette->high[k] = fmaxf(silhouette->high[k], middle[k] + radius);
    }
}

bool silhouette_open(struct silhouette *silhouette, struct rect stage)
{
    const float *low = silhouette->low, *high = silhouette->high;
    const struct rect box = {low[0], low[1], high[0] - low[0], high[1] - low[1]};
    const struct rect area = rect_intersect(rect_inset(stage, -AROUND), rect_inset(box, -AROUND));
    const float across = fmaxf(area.w, area.h) / (SILHOUETTE_SIDE - 3);
    if (area.w <= 0 || area.h <= 0) return false;
    silhouette->cell = fmaxf(FINEST, across);
    silhouette->area = rect_inset(area, -silhouette->cell);
    silhouette->columns = (int)(silhouette->area.w / silhouette->cell) + 1;
    silhouette->rows = (int)(silhouette->area.h / silhouette->cell) + 1;
    for (int row = 0; row < silhouette->rows; row++) {
        for (int column = 0; column < silhouette->columns; column++)
            silhouette->inside[row][column] = OUTSIDE * silhouette->cell;
        memset(silhouette->followed[row], 0, sizeof silhouette->followed[row]);
    }
    return true;
}

/// The nodes in a box, as first and last column and row. The outermost nodes stay outside, so that every outline closes.
static void find_nodes(const struct silhouette *silhouette, const float low[2], const float high[2], int nodes[2][2])
{
    const float from[2] = {silhouette->area.x, silhouette->area.y};
    const int count[2] = {silhouette->columns, silhouette->rows};
    const double cell = (double)silhouette->cell;
    for (int k = 0; k < 2; k++) {
        nodes[k][0] = (int)fmax(ceil((double)(low[k] - from[k]) / cell), 1);
        nodes[k][1] = (int)fmin(floor((double)(high[k] - from[k]) / cell), count[k] - 2);
    }
}

static void place_node(const struct silhouette *silhouette, int row, int column, float xy[2])
{
    xy[0] = silhouette->area.x + silhouette->cell * (float)column;
    xy[1] = silhouette->area.y + silhouette->cell * (float)row;
}

/// A disc of a tail, on the screen.
struct disc {
    float middle[2], radius;
};

/// Adds two discs and the area between them.
static void silhouette_add_link(struct silhouette *silhouette, const struct disc *a, const struct disc *b)
{
    const float *from = a->middle, *to = b->middle, reach = fmaxf(a->radius, b->radius) - OUTSIDE * silhouette->cell;
    const float low[2] = {fminf(from[0], to[0]) - reach, fminf(from[1], to[1]) - reach};
    const float high[2] = {fmaxf(from[0], to[0]) + reach, fmaxf(from[1], to[1]) + reach};
    const float dx = to[0] - from[0], dy = to[1] - from[1];
    int nodes[2][2];
    find_nodes(silhouette, low, high, nodes);
    for (int row = nodes[1][0]; row <= nodes[1][1]; row++) {
        for (int column = nodes[0][0]; column <= nodes[0][1]; column++) {
            float p[2];
            place_node(silhouette, row, column, p);
            const float t = segment_nearest(from, to, p), shares[3] = {0, t, 1};
            float *inside = &silhouette->inside[row][column];
            for (int k = 0; k < 3; k++) { // no hypotf() or fmaxf(): a view from near has many nodes
                const float x = p[0] - from[0] - shares[k] * dx, y = p[1] - from[1] - shares[k] * dy;
                const float depth = a->radius + shares[k] * (b->radius - a->radius) - sqrtf(x * x + y * y);
                if (depth > *inside) *inside = depth;
            }
        }
    }
}

/// Twice a triangle's area, positive if its corners are clockwise on the screen.
static float turn(const float a[2], const float b[2], const float c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

void silhouette_add_triangle(struct silhouette *silhouette, const float corner[3][2], const float inside[3])
{
    float low[2], high[2];
    int nodes[2][2];
    for (int k = 0; k < 2; k++) {
        low[k] = fminf(corner[0][k], fminf(corner[1][k], corner[2][k]));
        high[k] = fmaxf(corner[0][k], fmaxf(corner[1][k], corner[2][k]));
    }
    find_nodes(silhouette, low, high, nodes);
    const float area = turn(corner[0], corner[1], corner[2]), most = -OUTSIDE * silhouette->cell;
    for (int row = nodes[1][0]; row <= nodes[1][1] && area != 0; row++) {
        for (int column = nodes[0][0]; column <= nodes[0][1]; column++) {
            float *node = &silhouette->inside[row][column], share[3], p[2];
            if (*node >= most) continue; // another triangle has set it, as on a body's far side
            place_node(silhouette, row, column, p);
            for (int k = 0; k < 3; k++) share[k] = turn(corner[(k + 1) % 3], corner[(k + 2) % 3], p) / area;
            if (!(share[0] >= 0 && share[1] >= 0 && share[2] >= 0)) continue;
            const float depth = share[0] * inside[0] + share[1] * inside[1] + share[2] * inside[2];
            if (depth > *node) *node = depth < most ? depth : most;
        }
    }
}

void silhouette_soften(struct silhouette *silhouette)
{
    for (int row = 1; row + 1 < silhouette->rows; row++) {
        for (int column = 1; column + 1 < silhouette->columns; column++) {
            float sum = 0;
            for (int k = -1; k <= 1; k++) {
                const float *there = &silhouette->inside[row + k][column];
                sum += there[-1] + there[0] + there[1];
            }
            silhouette->blurred[row][column] = sum / 9;
        }
    }
    for (int row = 1; row + 1 < silhouette->rows; row++)
        memcpy(&silhouette->inside[row][1], &silhouette->blurred[row][1],
               (size_t)(silhouette->columns - 2) * sizeof silhouette->inside[row][1]);
}

enum side { SIDE_TOP, SIDE_RIGHT, SIDE_BOTTOM, SIDE_LEFT };

/// Whether the outline crosses a side of the cell with this upper left node, and where; `xy` may be NULL.
static bool crosses(const struct silhouette *silhouette, int row, int column, enum side side, float xy[2])
{
    const int rows[2] = {row + (side == SIDE_BOTTOM), row + (side != SIDE_TOP)};
    const int columns[2] = {column + (side == SIDE_RIGHT), column + (side != SIDE_LEFT)};
    const float a = silhouette->inside[rows[0]][columns[0]], b = silhouette->inside[rows[1]][columns[1]];
    if (!xy || (a >= 0) == (b >= 0)) return (a >= 0) != (b >= 0);
    const float along = a / (a - b) * silhouette->cell;
    place_node(silhouette, rows[0], columns[0], xy);
    xy[0] += along * (float)(columns[1] - columns[0]);
    xy[1] += along * (float)(rows[1] - rows[0]);
    return true;
}

/// Follows the outline that crosses a cell's upper side downwards, until it closes. Where all four sides of a cell are crossed, it turns
/// left around the corner.
static int follow_from(struct silhouette *silhouette, int row, int column)
{
    static const int down[4] = {-1, 0, 1, 0}, right[4] = {0, 1, 0, -1}, order[3] = {1, 3, 2};
    const int first_row = row, first_column = column;
    enum side in = SIDE_TOP;
    int count = 0;
    do {
        if (in == SIDE_TOP) silhouette->followed[row][column] = true;
        if (in == SIDE_BOTTOM) silhouette->followed[row + 1][column] = true;
        if (count < SILHOUETTE_POINTS - 1) crosses(silhouette, row, column, in, silhouette->points[count++]);
        enum side out = in;
        for (int i = 0; i < 3 && out == in; i++) {
            const enum side next = (in + (unsigned)order[i]) % 4;
            if (crosses(silhouette, row, column, next, NULL)) out = next;
        }
        if (out == in) break;
        row += down[out];
        column += right[out];
        in = (out + 2) % 4;
    } while (row != first_row || column != first_column || in != SIDE_TOP);
    memcpy(silhouette->points[count], silhouette->points[0], sizeof silhouette->points[0]);
    return count + 1;
}

int silhouette_follow(struct silhouette *silhouette)
{
    for (int row = 1; row + 1 < silhouette->rows; row++) {
        for (int column = 0; column + 1 < silhouette->columns; column++) {
            if (silhouette->followed[row][column] || !crosses(silhouette, row, column, SIDE_TOP, NULL)) continue;
            const int count = follow_from(silhouette, row, column);
            if (count > LEAST_POINTS) return count;
        }
    }
    return 0;
}

// Onion skins: outlines of a rig at knots near the playhead, and a ghost at the knot being edited.

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
    const int first = characters_rig(core);
    for (int r = -1; (r = document_next_rig(document, RIG_MODEL, r)) >= 0;) {
        const struct rig *rig = document->rigs[r];
        for (int i = 0; i < rig_input_count(rig); i++) {
            if (rig_input(rig, i) == core->focus.active) return r;
        }
    }
    const int strand = overlay_rig(stage, core);
    return strand >= 0 ? strand : first;
}

enum { STATIONS = 48 }; ///< along the tail

static const double FROM = 0.16,
                    TO = 0.985; ///< shares of the length: outside the body, and up to the rounded tip
static const float OPEN = 1.5f; ///< cells from the root's disc; closer parts of a tail's outline are not drawn

/// Outlines a tail, but for the outline's longest part at the root, where it joins the body.
static bool show_tail(struct stage *stage, struct core *core, const struct pose *pose, float width, uint32_t color,
                      float tip[2])
{
    struct disc discs[STATIONS];
    struct silhouette *silhouette = &stage->silhouette;
    silhouette_clear(silhouette);
    for (int i = 0; i < STATIONS; i++) {
        const double share = FROM + (TO - FROM) * i / (STATIONS - 1), at = share * (pose->count - 1);
        const int joint = at >= pose->count - 1 ? pose->count - 2 : (int)at;
        const vec3s from = vec3_from(pose->matrix[joint] + 12), to = vec3_from(pose->matrix[joint + 1] + 12);
        const vec3s point = glms_vec3_lerp(from, to, (float)(at - joint));
        if (!stage_project_point(stage, point.raw, discs[i].middle)) return false;
        const float metres = fox_tail_radius((float)share * FOX_TAIL_LENGTH) * pose->scale;
        discs[i].radius = metres * (float)stage_pixels_per_metre(stage, pose->matrix[joint] + 12);
        silhouette_widen(silhouette, discs[i].middle, discs[i].radius);
    }
    if (!silhouette_open(silhouette, core->view.layout.stage)) return false;
    for (int i = 1; i < STATIONS; i++) silhouette_add_link(silhouette, &discs[i - 1], &discs[i]);
    const int count = silhouette_follow(silhouette), whole = count - 1; // the last point repeats the first
    if (count > 0) {
        float(*points)[2] = silhouette->points;
        const float *root = discs[0].middle, reach = discs[0].radius + OPEN * silhouette->cell;
        int longest = 0, start = 0, run = 0;
        memcpy(points[whole], points[0], (size_t)whole * sizeof points[0]);
        for (int i = 0; i < 2 * whole; i++) {
            run = maths_hypotf(points[i][0] - root[0], points[i][1] - root[1]) < reach ? run + 1 : 0;
            if (run > longest && run < whole) longest = run, start = (i + 1) % whole;
        }
        drawlist_line(&core->list, points[start], longest > 0 ? whole - longest : count, width, color);
    }
    const struct disc *last = &discs[STATIONS - 1], *before = &discs[STATIONS - 3];
    const float dx = last->middle[0] - before->middle[0], dy = last->middle[1] - before->middle[1];
    const float share = last->radius / fmaxf(maths_hypotf(dx, dy), 1);
    tip[0] = last->middle[0] + share * dx;
    tip[1] = last->middle[1] + share * dy;
    return true;
}

/// Outlines a soft character. Its surface is posed in hover's skin and projected there; hover will pose the skin again.
static bool show_character(struct stage *stage, struct core *core, const struct rig_pose *pose, float width,
                           uint32_t color, float tip[2])
{
    const struct figure *figure = pose->model.figure;
    struct silhouette *silhouette = &stage->silhouette;
    float(*posed)[3] = stage->skin.posed;
    if (!figure || figure->character.vertex_count > stage->skin.capacity) return false;
    stage->skin.hash = 0;
    silhouette_clear(silhouette);
    figure_vertices(&pose->model, posed, NULL, NULL, NULL);
    for (int i = 0; i < figure->character.vertex_count; i++) {
        float xy[2];
        if (!stage_project_point(stage, posed[i], xy)) return false;
        memcpy(posed[i], xy, sizeof xy);
        silhouette_widen(silhouette, xy, 0);
    }
    if (!silhouette_open(silhouette, core->view.layout.stage)) return false;
    const float all[3] = {1e6f, 1e6f, 1e6f};
    for (int t = 0; t < figure->character.index_count; t += 3) {
        float corner[3][2];
        for (int k = 0; k < 3; k++) memcpy(corner[k], posed[figure->character.indices[t + k]], sizeof corner[k]);
        silhouette_add_triangle(silhouette, (const float(*)[2])corner, all);
    }
    silhouette_soften(silhouette);
    for (int count; (count = silhouette_follow(silhouette)) > 0;)
        drawlist_line(&core->list, silhouette->points[0], count, width, color);
    const float *low = silhouette->low, *high = silhouette->high;
    tip[0] = fminf(high[0], core->view.layout.stage.x + 0.9f * core->view.layout.stage.w);
    tip[1] = fmaxf(0.7f * low[1] + 0.3f * high[1], core->view.layout.stage.y + 20);
    return true;
}

/// Outlines a rig as a sample of its splines moves it, a chain by its line; `tip` receives a place for text. False if not visible.
static bool proxy_show(struct stage *stage, struct core *core, const struct posing *posing, int rig, int sample,
                       float width, uint32_t color, float tip[2])
{
    struct rig_pose pose;
    float points[ANGLES_MAX_JOINTS + 1][2];
    if (!rig_pose(posing, rig, sample + document_delay(posing->document, rig), &pose)) return false;
    if (pose.kind == RIG_TAIL) return show_tail(stage, core, &pose.strand, width, color, tip);
    if (pose.kind == RIG_MODEL) return show_character(stage, core, &pose, width, color, tip);
    if (pose.kind != RIG_CHAIN || pose.strand.count == 0) return false;
    for (int n = 0; n < pose.strand.count; n++) {
        if (!stage_project_point(stage, pose.strand.matrix[n] + 12, points[n])) return false;
    }
    drawlist_line(&core->list, points[0], pose.strand.count, width, color);
    memcpy(tip, points[pose.strand.count - 1], 2 * sizeof *tip);
    return true;
}

/// Onion skin (O): the outline of the tail or soft character, or the chain's line, at the active spline's knots nearest to the playhead.
static void onion_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const int rig = overlay_pose_rig(stage, core);
    if (!core->view.on[SWITCH_ONION] || !spline || rig < 0) return;
    const int track = spline->parameter[PARAMETER_EQUILIBRIUM].track;
    if (spline->knot_count == 0 && track >= 0) spline = document->splines[track]; // its equilibrium's knots

    // Samples of the knots nearest to the playhead, nearest first.
    const int most = document->rigs[rig]->kind == RIG_MODEL ? CHARACTER_SKINS : MAX_SKINS;
    const double position = core->view.playback.position;
    int samples[MAX_SKINS], count = 0;
    int after = spline_lower_bound(document, spline, (int)ceil(position)), before = after - 1;
    while (count < most && (before >= 0 || after < spline->knot_count)) {
        const int low = before >= 0 ? document_sample(document, spline->knots[before].frame) : 0;
        const int high = after < spline->knot_count ? document_sample(document, spline->knots[after].frame) : 0;
        const bool back = after == spline->knot_count || (before >= 0 && position - low <= high - position);
        samples[count++] = back ? low : high;
        before -= back;
        after += !back;
    }
    uint32_t color = spline_list_color(document, core->focus.active);
    const struct posing posing = stage_posing(core);
    for (int i = count - 1; i >= 0; i--) {
        float share = count > 1 ? (float)i / (float)(count - 1) : 0, tip[2];
        proxy_show(stage, core, &posing, rig, samples[i], 1.25f,
                   theme_fade(color, NEAREST + (FARTHEST - NEAREST) * share), tip);
    }
}

/// Ghost (F4): the same at a knot that is dragged or was just nudged, unless that pose is shown.
static void ghost_show(struct stage *stage, struct core *core)
{
    // The active spline's knot that is held by the pointer, or the only selected one after a nudge.
    const struct document *document = core->document;
    const struct drag *drag = &core->input.drag;
    const struct spline *spline = core->view.on[SWITCH_GHOST] ? core_active_spline(core) : NULL;
    int at = -1;
    if (spline && drag->owner && drag->knot && drag->moved) at = spline_find_id(spline, drag->knot);
    if (spline && !drag->owner && core->step.nudged_seconds > 0)
        at = selection_single(&core->focus.selection, spline);
    const int rig = at >= 0 ? overlay_pose_rig(stage, core) : -1;
    if (rig < 0) return;
    const struct knot *knot = &spline->knots[at];
    const int sample = document_sample(document, knot->frame);
    if (fabs(sample + document_delay(document, rig) - core->view.playback.position) < 0.5) return;
    const struct posing posing = stage_posing(core);
    const double left = !drag->owner ? fmin(core->step.nudged_seconds / FADE, 1) : 1;
    const uint32_t color = theme_fade(spline_list_color(document, core->focus.active), GHOST * (float)left);
    float tip[2];
    if (!proxy_show(stage, core, &posing, rig, sample, 1.5f, color, tip)) return;
    char text[32];
    snprintf(text, sizeof text, "%.4g", knot->frame);
    stage_note(core, roundf(tip[0] + 8), roundf(tip[1] + 4), FONT_NUMBER, theme()->text_dim, text);
}

// Motion arcs: the path of a tip, a character's vertex or a held point, with one mark per frame, fading away from the playhead.

enum {
    MAX_REACH = TRAIL_FRAMES / 2 - 1, ///< frames to each side
    PIECES = 3,                       ///< straight pieces per frame
    RUN = 4,                          ///< frames of equal opacity
};

static const double REACH = 2;                            ///< seconds to each side
static const float OPACITY = 0.85f, MARK = 2.5f, NOW = 5; ///< mark radii in pixels; NOW: at the playhead

struct rig_point overlay_point(struct stage *stage, const struct core *core)
{
    const int rig = overlay_rig(stage, core);
    if (rig >= 0) return (struct rig_point){rig, bones_joints(core, rig) - 1};
    const int soft = characters_rig(core);
    const struct figure *figure = models_figure(core->models, core->document, soft);
    if (!figure) return (struct rig_point){-1, -1};
    struct liveliest *kept = &stage->liveliest;
    if (kept->figure != figure->id || kept->version != figure->version) { // search all vertices once
        const struct character *character = &figure->character;
        float most = -1;
        *kept = (struct liveliest){figure->id, figure->version, 0};
        for (int i = 0; i < character->vertex_count; i++) {
            float way = 0;
            for (int k = 0; k < character->coordinate_count; k++) {
                const struct coordinate *c = &character->coordinates[k];
                way += glms_vec3_norm2(vec3_from(c->re[i])) + glms_vec3_norm2(vec3_from(c->im[i]));
            }
            if (way > most) kept->vertex = i;
            most = fmaxf(most, way);
        }
    }
    return (struct rig_point){soft, kept->vertex};
}

static bool loops(const struct document *document, int spline)
{
    return spline < 0 || spline_start(document->splines[spline]) == WIGGLY_LOOP;
}

/// Whether the document has the point and, for a character, its model.
static bool point_exists(const struct core *core, struct rig_point point)
{
    const struct document *document = core->document;
    if (point.rig < 0 || point.rig >= document->rig_count) return false;
    const enum rig_kind kind = document->rigs[point.rig]->kind;
    if (point.at < 0) return point.at == POINT_BASE && kind == RIG_TAIL;
    if (kind == RIG_TAIL || kind == RIG_CHAIN) return point.at < bones_joints(core, point.rig);
    const struct figure *figure = models_figure(core->models, document, point.rig);
    return figure && point.at < figure->character.vertex_count;
}

/// World place of the point at a position in samples; false if its model is missing.
static bool point_place(const struct core *core, struct rig_point point, double position, float place[3])
{
    struct rig_pose pose;
    const struct posing posing = stage_posing(core);
    if (!point_exists(core, point) || !rig_pose(&posing, point.rig, position, &pose)) return false;
    if (pose.kind == RIG_MODEL) {
        figure_vertex(&pose.model, point.at, place);
    } else {
        memcpy(place, pose.strand.matrix[point.at + 1] + 12, 3 * sizeof *place);
    }
    return true;
}

static float fade_at(double frames, double reach) { return OPACITY * fmaxf(0, 1 - (float)(fabs(frames) / reach)); }

void path_show(struct stage *stage, struct core *core, enum trail which, struct rig_point point)
{
    const struct document *document = core->document;
    const struct rig *rig = document->rigs[point.rig];
    const double now = core->view.playback.position / document->substeps;
    const double reach = fmin(fmax(REACH * document->fps, 1), MAX_REACH);
    int first = (int)ceil(now - reach), last = (int)floor(now + reach), count = 0;

    // Frames beyond the range repeat if everything that moves the rig loops. A chain's clip repeats anyway.
    bool repeats = rig_input_count(rig) > 0;
    for (int i = 0; i < rig_input_count(rig); i++) repeats &= loops(document, rig_input(rig, i));
    for (int k = 0; k < 3 && rig->kind == RIG_TAIL; k++) repeats &= loops(document, rig->tail.position[k].track);
    const int end = document->last_frame - document->first_frame;
    if (!repeats && first < 0) first = 0;
    if (!repeats && last > end) last = end;

    // The point's world place at each frame, kept until an edit.
    const uint64_t solved = core->evaluation ? core->evaluation->revision : 0;
    uint64_t key = hash_word(hash_word(HASH_START, history_revision(core->history)), solved);
    key = hash_word(hash_word(key, (uint64_t)point.rig << 8 | (uint64_t)core->view.look), (uint64_t)point.at);
    float screen[TRAIL_FRAMES][2], points[PIECES * TRAIL_FRAMES][2];
    for (int frame = first; frame <= last; frame++) {
        struct trail_point *kept = &stage->trail[which][(frame % TRAIL_FRAMES + TRAIL_FRAMES) % TRAIL_FRAMES];
        if (kept->key != key || kept->frame != frame) {
            *kept = (struct trail_point){.key = key, .frame = frame};
            point_place(core, point, (double)frame * document->substeps, kept->place);
        }
        if (!stage_project_point(stage, kept->place, screen[count++])) return;
    }
    if (count == 0) return;

    // Catmull-Rom interpolation on the screen.
    int made = 0;
    for (int i = 0; i + 1 < count; i++) {
        const float *a = screen[i > 0 ? i - 1 : i], *b = screen[i], *c = screen[i + 1];
        const float *d = screen[i + 2 < count ? i + 2 : i + 1];
        for (int p = 0; p < PIECES; p++, made++) {
            const float u = (float)p / PIECES;
            for (int k = 0; k < 2; k++) {
                const float m0 = 0.5f * (c[k] - a[k]), m1 = 0.5f * (d[k] - b[k]), step = c[k] - b[k];
                points[made][k] = b[k] + u * (m0 + u * (3 * step - 2 * m0 - m1 + u * (m0 + m1 - 2 * step)));
            }
        }
    }
    memcpy(points[made++], screen[count - 1], sizeof points[0]);
    for (int i = 0; i + 1 < made; i += RUN * PIECES) {
        const int length = made - i < RUN * PIECES + 1 ? made - i : RUN * PIECES + 1;
        const float alpha = fade_at(first + (i + length / 2.0) / PIECES - now, reach);
        if (alpha > 0.02f)
            drawlist_line(&core->list, points[i], length, 1.5f, theme_fade(theme()->playhead, 0.7f * alpha));
    }
    for (int i = 0; i < count; i++) {
        const float alpha = fade_at(first + i - now, reach);
        const struct rect mark = {screen[i][0] - MARK / 2, screen[i][1] - MARK / 2, MARK, MARK};
        if (alpha > 0.02f) drawlist_rect(&core->list, mark, theme_fade(theme()->playhead, alpha));
    }
}

/// Motion arc (Shift+O): the point's path within two seconds of the playhead, with a mark per frame.
static void trail_show(struct stage *stage, struct core *core)
{
    float place[3], xy[2];
    if (!core->view.on[SWITCH_TRAIL]) return;
    const struct rig_point point = overlay_point(stage, core);
    if (!point_exists(core, point)) return;
    path_show(stage, core, TRAIL_OF_TIP, point);

    // A ring where the point is now: a tip follows a dragged body.
    const bool seen = strand_of(stage, point.rig) ? stage_project(stage, point.rig, point.at + 1, 0, xy)
                                                  : point_place(core, point, core->view.playback.position, place) &&
                                                        stage_project_point(stage, place, xy);
    if (seen) drawlist_circle(&core->list, xy, NOW, 1.5f, theme()->playhead);
}

void overlays_show(struct stage *stage, struct core *core)
{
    onion_show(stage, core);
    ghost_show(stage, core);
    trail_show(stage, core);
}

// Pins: hover, drags parallel to the screen, keys and markers.

static const float MARKER_REACH = 9;    ///< pixels
static const float LEAST_SHARE = 0.05f; ///< of the largest movement; vertices that move less are not offered

/// The surface vertex under a point; of several characters the one nearest to the eye.
static struct hover find_vertex(struct stage *stage, const struct core *core, float x, float y)
{
    const struct stage_view *view = &stage->view;
    struct hover hover = {.thing = NULL};
    float nearest = INFINITY;
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        const struct figure *figure = shown->posed.figure;
        struct surface_spot spot;
        float xy[2];
        if (!skin_pose(stage, shown->rig) || !skin_spot(stage, figure, x, y, &spot)) continue;
        const int rig = shown->rig, vertex = spot_vertex(&spot);
        if (!point_exists(core, (struct rig_point){rig, vertex})) continue; // an edit in the same frame removed it
        const float *place = stage->skin.posed[vertex];
        const float depth = camera_depth(view->view, view->eye, place);
        if (depth >= nearest) continue;
        nearest = depth;
        hover.thing = NULL;

        // The vertex's movement per unit of the coordinates, squared, relative to the largest movement along each axis.
        float own = 0, most = 0;
        const struct model_rig *driven = &core->document->rigs[rig]->model;
        for (int k = 0; k < driven->drive_count; k++) {
            const int n = figure_find(figure, driven->drives[k].name);
            if (n < 0) continue;
            const struct coordinate *moves = &figure->character.coordinates[n];
            own += glms_vec3_norm2(vec3_from(moves->re[vertex])) + glms_vec3_norm2(vec3_from(moves->im[vertex]));
            most += glms_vec3_norm2(vec3_from(figure->largest[n]));
        }
        if ((most > 0 ? own / most : 0) < LEAST_SHARE * LEAST_SHARE) continue;
        if (!stage_project_point(stage, place, xy)) continue;
        hover = (struct hover){.thing = &thing_point, .rig = rig, .joint = vertex, .x = xy[0], .y = xy[1]};
    }
    return hover;
}

static bool project_place(const struct stage *stage, const double place[3], float xy[2])
{
    const float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    return stage_project_point(stage, at, xy);
}

struct hover pins_hover(struct stage *stage, const struct core *core, const struct hover *found, float x, float y)
{
    struct hover hover = {.thing = NULL};
    const float reach = core_reach(core, MARKER_REACH);
    float best = reach;

    // The marker under the point: the selected one, else the nearest.
    struct pin_place place = PINS_START;
    for (const struct pin *pin; (pin = pins_next(core->document, &place));) {
        float xy[2];
        if (!project_place(stage, pin->to, xy)) continue;
        float distance = maths_hypotf(xy[0] - x, xy[1] - y);
        if (distance < reach && core->focus.pin == pin->id) distance = 0;
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){
            .thing = &thing_pin, .rig = place.rig, .joint = pin->point, .pin = pin->id, .x = xy[0], .y = xy[1]};
    }
    if (hover.thing || found->thing) return hover;

    // A vertex, cached while pointer and picture stay. Playback under a still pointer highlights nothing.
    struct pointed *pointed = &stage->pointed;
    const bool still = pointed->x == x && pointed->y == y, same = still && pointed->hash == stage->view.hash;
    if (still && !same && core->view.playback.playing) return hover;
    if (!same) *pointed = (struct pointed){x, y, stage->view.hash, find_vertex(stage, core, x, y)};
    return pointed->hover;
}

/// The screen's directions in the world, and its scale at a place.
static void pins_take_plane(const struct stage *stage, const double place[3], struct pin_drag *drag)
{
    const struct stage_view *view = &stage->view;
    const float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    drag->pixels_per_metre = stage_pixels_per_metre(stage, at);
    for (int k = 0; k < 3; k++) {
        drag->right[k] = (double)view->view[4 * k];
        drag->up[k] = (double)view->view[4 * k + 1];
    }
}

/// Moves the point or marker to the pointer.
static void move_pin(void *room, struct core *core)
{
    const struct pin_drag *drag = &((const struct stage *)room)->pin_drag;
    const double dx = core->input.drag.moved_x, dy = core->input.drag.moved_y;
    const int axis = drag->axis;
    double to[3];
    for (int k = 0; k < 3; k++) {
        to[k] = drag->start[k];
        if (axis < 0) to[k] += (dx * drag->right[k] - dy * drag->up[k]) / drag->pixels_per_metre;
    }
    if (axis >= 0)
        to[axis] += stage_along(drag->right[axis], drag->up[axis], &core->input.drag) / drag->pixels_per_metre;
    pins_put(core, drag->point.rig, drag->point.at, drag->frame, to);
}

static enum drag_answer pin_event(void *room, struct core *core, const struct event *event)
{
    // Ctrl may still be held from grabbing a joint.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    return key && drag_lock_axis(&core->input.drag, &((struct stage *)room)->pin_drag.axis, event->key) ? DRAG_USED
                                                                                                        : DRAG_PASSES;
}

static const float HERE = 5, ELSEWHERE = 3.5f, RING = 8, LIT = 6.5f, END = 2; ///< radii, pixels
static const float LEAST_LINE = 1.5f;                                         ///< pixels; shorter lines are not drawn
static const float FAINT = 0.5f;                                              ///< opacity of markers at other frames
static const float AXIS = 2; ///< metres of a locked axis to each side, as drawn

/// Draws the axis of a locked drag.
static void pins_show_axis(void *room, struct core *core)
{
    const struct stage *stage = room;
    const struct pin_drag *drag = &stage->pin_drag;
    float ends[2][3], line[2][2];
    if (drag->axis < 0) return;
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 3; k++) ends[e][k] = (float)drag->start[k];
        ends[e][drag->axis] += e ? AXIS : -AXIS;
        if (!stage_project_point(stage, ends[e], line[e])) return;
    }
    drawlist_dashed(&core->list, line[0], 2, 1, 6, 4, theme_fade(theme()->playhead, 0.7f));
}

static void press_pin(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    static const struct drag_owner owner = {
        .cursor = CURSOR_HAND, .apply = move_pin, .event = pin_event, .end = stage_click, .show = pins_show_axis};
    struct pin_drag *drag = &stage->pin_drag;
    const struct document *document = core->document;
    drag_begin(core, &owner, stage, hover->thing == &thing_pin ? "Move pin" : "Pin", event);
    *drag = (struct pin_drag){.point = {hover->rig, hover->joint}, .axis = -1};
    if (hover->thing == &thing_pin) {
        const struct rig *rig = document->rigs[hover->rig];
        const struct pin *pin = &rig->pins[pins_find_id(rig, hover->pin)];
        pins_visit(core, pin);
        drag->frame = pin->frame;
        memcpy(drag->start, pin->to, sizeof drag->start);
    } else {
        float place[3] = {0};
        drag->frame = pins_frame_here(core, hover->rig);
        playback_seek(core, drag->frame);
        point_place(core, drag->point, core->view.playback.position, place);
        for (int k = 0; k < 3; k++) drag->start[k] = (double)place[k];
    }
    pins_take_plane(stage, drag->start, drag);
}

static bool find_pin(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)core;
    return project_place(room, target->pin->to, xy);
}

/// pin(tail,0): a pin's marker, counted by frame.
const struct thing thing_pin = {
    .cursor = CURSOR_MOVE,
    .hint = "Drag the pin (X, Y or Z locks an axis, Shift: fine); Del removes it; Alt+arrows nudge it",
    .place = ON_PIN,
    .press = press_pin,
    .name = "pin",
    .of = OF_PIN,
    .numbers = 1,
    .find = find_pin,
    .missing = "that pin is not in sight"};

static const float FRONT_SHARE = 0.1f; ///< weight of depth, to prefer front vertices

/// The vertex seen at a share of the width and height from the front, at rest.
static bool find_character(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct stage *stage = room;
    const struct stage_model *shown = stage_soft_shown(stage, target->rig);
    (void)core;
    if (!shown) return false;
    const struct figure *figure = shown->posed.figure;
    const float *lo = figure->lo, *hi = figure->hi;
    const float x = lo[0] + (float)target->number[0] * (hi[0] - lo[0]);
    const float y = lo[1] + (float)target->number[1] * (hi[1] - lo[1]);
    float best = INFINITY, point[3];
    int found = 0;
    for (int i = 0; i < figure->character.vertex_count; i++) {
        const float *p = figure->character.position[i];
        const float cost = maths_hypotf(p[0] - x, p[1] - y) - FRONT_SHARE * p[2];
        if (!(cost < best)) continue;
        best = cost;
        found = i;
    }
    figure_vertex(&shown->posed, found, point);
    return stage_project_point(stage, point, xy);
}

/// character(up,0.5,0.8): a surface point where it is now. u runs across and v up the rest pose's box, seen from the front.
const struct thing thing_point = {
    .cursor = CURSOR_HAND,
    .hint = "Drag to pin this point at the playhead (X, Y or Z locks an axis, Shift: fine); H pins it where it is",
    .press = press_pin,
    .name = "character",
    .of = OF_RIG,
    .rig = RIG_MODEL,
    .numbers = 2,
    .find = find_character,
    .missing = "that character is not to be seen"};

static const double NUDGE = 0.01; ///< of the view's height

void stage_nudge_pin(struct stage *stage, struct core *core, double right, double up)
{
    int rig;
    struct pin_drag plane;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    pins_take_plane(stage, pin->to, &plane);
    const double step = core_round(NUDGE * (double)core->view.layout.stage.h / plane.pixels_per_metre, 0.01);
    double by[3];
    for (int k = 0; k < 3; k++) by[k] = step * (right * plane.right[k] + up * plane.up[k]);
    pins_nudge(core, by);
}

/// Pins a point at the playhead where it is.
static void pin_here(struct core *core, struct rig_point point)
{
    float place[3];
    if (!point_exists(core, point)) {
        core_message(core, false, "There is no tail, chain or character to pin.");
        return;
    }
    const double frame = pins_frame_here(core, point.rig);
    if (!point_place(core, point, core_position(core->document, frame), place)) return;
    pins_put_here(core, point.rig, point.at, (const double[3]){place[0], place[1], place[2]});
}

void stage_hold_point(struct stage *stage, struct core *core)
{
    int rig;
    struct hover hover = core->input.hover;
    if (is_strand(&hover)) hover = strand_end(stage, &hover);
    const struct pin *selected = pins_selected(core, &rig);
    if (hover.thing == &thing_point) {
        pin_here(core, (struct rig_point){hover.rig, hover.joint});
    } else if (selected) {
        const struct pin pin = *selected;
        pins_put_here(core, rig, pin.point, pin.to);
    } else {
        pin_here(core, overlay_point(stage, core));
    }
}

void pins_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    struct drawlist *list = &core->list;
    int rig;
    struct pin_place place = PINS_START;
    const struct pin *chosen = pins_selected(core, &rig);
    if (chosen && point_exists(core, (struct rig_point){rig, chosen->point}))
        path_show(stage, core, TRAIL_OF_PIN, (struct rig_point){rig, chosen->point});
    for (const struct pin *pin; (pin = pins_next(core->document, &place));) {
        // The target, and a line to the point at the pin's frame if known.
        const struct pin_left *left = evaluation_pin(core->evaluation, document, place.rig, place.at);
        const bool here = document_sample(document, pin->frame) == document_sample(document, core_frame(core));
        const bool selected = core->focus.pin == pin->id;
        const bool hot = core->input.hover.thing == &thing_pin && core->input.hover.pin == pin->id;
        const float radius = here || selected || hot ? HERE : ELSEWHERE;
        const uint32_t color = theme_fade(pins_color(document, place.rig), here || selected || hot ? 1 : FAINT);
        float line[2][2];
        if (!project_place(stage, pin->to, line[0])) continue;
        const bool has_end = left && left->is_found && project_place(stage, left->at, line[1]);
        if (has_end && maths_hypotf(line[1][0] - line[0][0], line[1][1] - line[0][1]) > LEAST_LINE) {
            drawlist_line(list, line[0], 2, 1.25f, color);
            drawlist_disc(list, line[1], END, color);
        }
        drawlist_disc(list, line[0], radius + 1.5f, theme_fade(theme()->panel, here || selected ? 0.8f : 0.4f));
        drawlist_disc(list, line[0], radius, color);
        if (!selected && !hot) continue;
        char text[32];
        snprintf(text, sizeof text, "%.6g", pin->frame);
        drawlist_circle(list, line[0], RING, 1.5f, theme()->playhead);
        stage_note(core, line[0][0] + RING + 8, line[0][1] + 4, FONT_NUMBER, theme()->text, text);
    }
    if (core->input.hover.thing != &thing_point || core->input.drag.owner) return;
    const float xy[2] = {core->input.hover.x, core->input.hover.y}; // the target of a press
    drawlist_circle(list, xy, LIT + 1.5f, 1.5f, theme_fade(theme()->panel, 0.6f));
    drawlist_circle(list, xy, LIT, 1.5f, theme()->playhead);
    drawlist_disc(list, xy, END, theme()->playhead);
}
