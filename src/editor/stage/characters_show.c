/// What is written over the stage where characters are: the legend of the phase map, and what the two of a pair are.
#include "editor/core/characters.h"
#include "editor/stage/overlays.h"
#include "editor/stage/rigs.h"
#include "rig/camera.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { SECTORS = 36, RINGS = 5, LEGEND_WIDTH = 196, LEGEND_HEIGHT = 132 };

static const float WHEEL = 30; ///< radius
static const float TEXT_SIZE = 11;

/// Amplitude grows outwards. Rings lie one on the other, and sectors overlap by a bit, so that no edge shows.
static void show_wheel(struct drawlist *list, float x, float y)
{
    const float step = 6.28318531f / SECTORS;
    for (int ring = RINGS; ring >= 1; ring--) {
        const float radius = WHEEL * (float)ring / RINGS, amplitude = ((float)ring - 0.5f) / (RINGS - 0.5f);
        for (int s = 0; s < SECTORS; s++) {
            const float middle = step * (float)s, from = middle - 0.62f * step, to = middle + 0.62f * step;
            const float xy[] = {
                x, y, x + radius * cosf(from), y - radius * sinf(from), x + radius * cosf(to), y - radius * sinf(to)};
            drawlist_convex(list, xy, 3, phase_color(amplitude * cosf(middle), amplitude * sinf(middle)));
        }
    }
}

/// The lines that the map on the stage has, as stage_mesh.frag draws them.
static void show_spokes(struct drawlist *list, float x, float y)
{
    for (int i = 0; i < 8; i++) {
        const float angle = 0.785398163f * ((float)i + 0.5f), along = cosf(angle), up = sinf(angle),
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

/// Angles are as in the plane: in step to the right, a quarter ahead on top.
static void show_legend(struct core *core, const struct coordinate *coordinate)
{
    static const char *const directions[] = {"left and right (x)", "up and down (y)", "back and forth (z)"};
    struct drawlist *list = &core->list;
    const struct rect box = characters_legend(core);
    const float x = box.x + box.w / 2, y = box.y + 80;
    char title[96];
    snprintf(title, sizeof title, "%.40s: %s", coordinate->name, directions[core->characters.axis]);
    drawlist_rounded(list, box, 6, (theme()->panel & 0xFFFFFF00u) | 0xD8u);
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

/// A line under the feet of each of the pair.
static void show_pair(const struct stage *stage, struct core *core)
{
    static const char *const names[] = {"with their phases", "real parts only"};
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

void characters_show(const struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct coordinate *coordinate = characters_coordinate(core, world);
    if ((core->characters.mapped || core->brush.on) && coordinate) show_legend(core, coordinate);
    if (core->characters.compare) show_pair(stage, core);
}
