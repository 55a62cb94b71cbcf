/// Which tail is which, where there are several.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/stage/overlays.h"
#include "editor/stage/rigs.h"
#include "model/creature.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

enum { BELOW = 14, HEIGHT = 20, PAD = 6, DOT = 8 }; ///< pixels; the first: of a name under the feet

static const float FEET = -0.5f; ///< z of the paws from where the tail begins, metres, bind size

/// Where the name of a tail goes; false where its feet are behind the eye.
static bool place_name(const struct stage *stage, const struct core *core, int tail, const char *name,
                       struct rect *place)
{
    const struct pose *pose = &stage->view.tails[tail].pose;
    const float *base = pose->matrix[0] + 12;
    const float feet[3] = {base[0], pose->ground, base[2] + FEET * pose_length(pose) / CREATURE_TAIL_LENGTH};
    const struct rect r = core->layout.stage;
    float xy[2];
    if (!stage_project_point(stage, r, feet, xy)) return false;
    place->w = ceilf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, name)) + DOT + 3 * PAD;
    place->h = HEIGHT;
    place->x = roundf(fmaxf(fminf(xy[0] - place->w / 2, r.x + r.w - place->w), r.x));
    place->y = roundf(fminf(xy[1] + BELOW, r.y + r.h - HEIGHT));
    return true;
}

static bool overlap(const struct rect *a, const struct rect *b)
{
    return a->x < b->x + b->w && b->x < a->x + a->w && a->y < b->y + b->h && b->y < a->y + a->h;
}

static void show_name(struct core *core, const struct rect *place, uint32_t color, const char *name)
{
    const struct rect dot = {place->x + PAD, place->y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
    drawlist_rounded(&core->list, *place, HEIGHT / 2.0f, theme()->panel);
    drawlist_rounded(&core->list, dot, 2, color);
    drawlist_text(&core->list, dot.x + DOT + PAD, place->y + HEIGHT - PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                  theme()->text, name);
}

/// A name that would lie over another one is left out.
void names_show(const struct stage *stage, struct core *core, const struct document *document)
{
    struct rect shown[STAGE_MAX_TAILS], place;
    int count = 0, rig = document_next_rig(document, RIG_TAIL, 0);
    for (int t = 0; rig >= 0 && t < stage->view.tail_count && stage->view.tail_count > 1; t++) {
        const struct tail *tail = &document->rigs[rig].tail;
        const char *name = document->rigs[rig].name;
        const uint32_t color =
            tail->channel_count > 0 ? arrange_color(document, tail->channels[0].spline) : theme()->text_dim;
        bool free = place_name(stage, core, t, name, &place);
        for (int i = 0; i < count && free; i++) free = !overlap(&place, &shown[i]);
        if (free) show_name(core, &place, color, name);
        if (free) shown[count++] = place;
        rig = document_next_rig(document, RIG_TAIL, rig + 1);
    }
}
