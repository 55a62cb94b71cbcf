/// Soft characters on the stage: posing, and the legend of their phases.
#include "editor/core/characters.h"
#include "base/hash.h"
#include "base/names.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { BOUND_STEPS = 30 };

static const float FRONT_SHARE = 0.1f; ///< weight of depth, to prefer front vertices

#define PAIR_GAP 0.58f /* from the middle to each of a pair, in widths of the character */

/// Each one's distance from the middle of a pair.
static float pair_offset(const struct figure *figure) { return PAIR_GAP * (figure->hi[0] - figure->lo[0]); }

static void add_soles(struct stage_view *view, const struct stage_character *shown)
{
    const struct figure *figure = shown->figure;
    const float width = figure->hi[0] - figure->lo[0], depth = figure->hi[2] - figure->lo[2];
    const float *p = shown->position;
    stage_add_blob(view, p[0] + 0.5f * (figure->lo[0] + figure->hi[0]), p[2] + 0.5f * (figure->lo[2] + figure->hi[2]),
                   0.32f * (width + depth), 0.5f);
    for (int s = 0; s < FIGURE_SOLES; s++) {
        const struct sole *sole = &figure->soles[s];
        if (sole->radius > 0.0f) stage_add_blob(view, p[0] + sole->x, p[2] + sole->z, 1.35f * sole->radius, 0.7f);
    }
}

/// A figure on the stage, `aside` metres beside its rig's place.
static void add_character(struct stage *stage, const struct core *core, int rig, int n, float aside)
{
    struct stage_view *view = &stage->view;
    const struct character_view *how = &core->characters;
    const struct character_rig *character = &core->document->rigs[rig]->character;
    struct posing posing = stage_posing_by_hand(stage);
    struct rig_pose posed;
    if (aside > 0) posing.look = LOOK_STIFF;
    if (view->character_count == STAGE_MAX_CHARACTERS) return;
    if (!rig_pose(&posing, rig, core->playback.position, NULL, &posed)) return;
    struct stage_character *shown = &view->characters[view->character_count++];
    *shown =
        (struct stage_character){.figure = posed.character.figure,
                                 .morph = posed.character.morph,
                                 .rig = n,
                                 .is_twin = aside > 0,
                                 .coarse = how->compare || document_count_rigs(core->document, RIG_CHARACTER) > 1,
                                 .map_coordinate = -1,
                                 .map_axis = how->axis};
    for (int k = 0; k < 3; k++) shown->position[k] = posed.character.position[k] + (k == 0 ? aside : 0.0f);
    const int drive = how->drive < character->drive_count ? how->drive : 0;
    const bool is_painted = core->brush.on && n == how->character;
    if ((how->mapped || is_painted) && character->drive_count > 0)
        shown->map_coordinate = figure_find(shown->figure, character->drives[drive].name);
    add_soles(view, shown);
}

static void pose(struct stage *stage, const struct core *core, int rig, int n)
{
    const struct figure *figure = models_figure(core->models, n);
    if (!figure) return;
    if (!core->characters.compare) {
        add_character(stage, core, rig, n, 0.0f);
    } else {
        add_character(stage, core, rig, n, -pair_offset(figure));
        add_character(stage, core, rig, n, pair_offset(figure));
    }
}

static float aside(const struct core *core, int n)
{
    return core->characters.compare ? pair_offset(models_figure(core->models, n)) : 0.0f;
}

static uint64_t hash(uint64_t sum, const struct stage_view *view)
{
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        const struct morph *morph = &shown->morph;
        const int looks[] = {shown->coarse, shown->map_coordinate, shown->map_axis};
        sum = hash_word(hash_word(sum, shown->figure->id), shown->figure->version);
        sum = hash_bytes(sum, shown->position, sizeof shown->position);
        sum = hash_bytes(sum, looks, sizeof looks);
        sum = hash_bytes(sum, morph->coordinate, (size_t)morph->count * sizeof *morph->coordinate);
        sum = hash_bytes(sum, morph->weight, (size_t)morph->count * sizeof *morph->weight);
    }
    return sum;
}

const struct stage_kind character_stage = {.pose = pose, .bound_steps = BOUND_STEPS, .aside = aside, .hash = hash};

/// The vertex seen at `uv` from the front, at rest.
static int front_vertex(const struct figure *figure, const double uv[2])
{
    const float *lo = figure->lo, *hi = figure->hi;
    const float x = lo[0] + (float)uv[0] * (hi[0] - lo[0]), y = lo[1] + (float)uv[1] * (hi[1] - lo[1]);
    float best = INFINITY;
    int found = 0;
    for (int i = 0; i < figure->character.vertex_count; i++) {
        const float *p = figure->character.position[i];
        const float cost = maths_hypotf(p[0] - x, p[1] - y) - FRONT_SHARE * p[2];
        if (!(cost < best)) continue;
        best = cost;
        found = i;
    }
    return found;
}

bool find_character(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct stage *stage = room;
    const struct stage_character *shown = stage_character_shown(stage, target->nth);
    float point[3];
    (void)core;
    if (!shown) return false;
    const int vertex = front_vertex(shown->figure, target->number);
    stage_vertex(shown->figure, &shown->morph, shown->position, vertex, point);
    return stage_project_point(stage, stage->view.viewport, point, xy);
}

enum { SECTORS = 36, RINGS = 5, LEGEND_WIDTH = 196, LEGEND_HEIGHT = 132 };

static const float WHEEL = 30; ///< radius
static const float TEXT_SIZE = 11;

/// Amplitude grows outwards. Rings and sectors overlap, so that no edges show.
static void show_wheel(struct drawlist *list, float x, float y)
{
    const float step = 6.28318531f / SECTORS;
    for (int ring = RINGS; ring >= 1; ring--) {
        const float radius = WHEEL * (float)ring / RINGS, amplitude = ((float)ring - 0.5f) / (RINGS - 0.5f);
        for (int s = 0; s < SECTORS; s++) {
            const float middle = step * (float)s, from = middle - 0.62f * step, to = middle + 0.62f * step;
            const float xy[] = {x,
                                y,
                                x + radius * maths_cosf(from),
                                y - radius * maths_sinf(from),
                                x + radius * maths_cosf(to),
                                y - radius * maths_sinf(to)};
            drawlist_convex(list, xy, 3, phase_color(amplitude * maths_cosf(middle), amplitude * maths_sinf(middle)));
        }
    }
}

/// The same lines as on the character (stage_mesh.frag).
static void show_spokes(struct drawlist *list, float x, float y)
{
    for (int i = 0; i < 8; i++) {
        const float angle = 0.785398163f * ((float)i + 0.5f), along = maths_cosf(angle), up = maths_sinf(angle),
                    from = 0.2f * WHEEL;
        const float xy[] = {x + from * along, y - from * up, x + WHEEL * along, y - WHEEL * up};
        drawlist_line(list, xy, 2, 1.25f, 0x000000A0u);
    }
}

static void show_centred(struct drawlist *list, float x, float y, const char *text, uint32_t color)
{
    const float width = font_width(FONT_LABEL, TEXT_SIZE, text);
    drawlist_text(list, x - width / 2, y, FONT_LABEL, TEXT_SIZE, color, text);
}

struct rect characters_legend(const struct core *core)
{
    const struct rect stage = core->layout.stage;
    return (struct rect){stage.x + 12, stage.y + stage.h - LEGEND_HEIGHT - 12, LEGEND_WIDTH, LEGEND_HEIGHT};
}

/// Angles as in the complex plane: in step to the right, a quarter ahead at the top.
static void show_legend(struct core *core, const struct coordinate *coordinate)
{
    static const char *const directions[] = {"left and right (x)", "up and down (y)", "back and forth (z)"};
    struct drawlist *list = &core->list;
    const struct rect box = characters_legend(core);
    const float x = box.x + box.w / 2, y = box.y + 80;
    char title[96];
    snprintf(title, sizeof title, "%.*s: %s", name_fit(coordinate->name, 40), coordinate->name,
             directions[core->characters.axis]);
    stage_scrim(core, box);
    drawlist_text_fit(list, box.x + 10, box.y + 18, box.w - 20, FONT_LABEL, TEXT_SIZE, theme()->text, title);
    show_wheel(list, x, y);
    show_spokes(list, x, y);
    show_centred(list, x, y - WHEEL - 6, "ahead", theme()->text_dim);
    show_centred(list, x, y + WHEEL + 14, "behind", theme()->text_dim);
    drawlist_text(list, x + WHEEL + 8, y + 4, FONT_LABEL, TEXT_SIZE, theme()->text_dim, "in step");
    const char *left = "opposite";
    drawlist_text(list, x - WHEEL - 8 - font_width(FONT_LABEL, TEXT_SIZE, left), y + 4, FONT_LABEL, TEXT_SIZE,
                  theme()->text_dim, left);
}

/// A line under the feet of each of a pair.
static void show_pair(const struct stage *stage, struct core *core)
{
    static const char *const names[] = {"with phases", "without phases"};
    const struct stage_view *view = &stage->view;
    const struct rect r = core->layout.stage;
    for (int i = 0; i < view->character_count; i++) {
        const struct stage_character *shown = &view->characters[i];
        const float feet[3] = {shown->position[0], shown->position[1], shown->position[2] + shown->figure->hi[2]};
        float xy[2];
        if (!stage_project_point(stage, r, feet, xy)) continue;
        show_centred(&core->list, xy[0], fminf(xy[1] + 22, r.y + r.h - 8), names[i % 2], theme()->text_dim);
    }
}

void characters_show(const struct stage *stage, struct core *core)
{
    const struct coordinate *coordinate = characters_coordinate(core);
    if ((core->characters.mapped || core->brush.on) && coordinate) show_legend(core, coordinate);
    if (core->characters.compare) show_pair(stage, core);
}
