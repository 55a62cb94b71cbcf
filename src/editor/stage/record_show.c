/// What is drawn of a body's motion: the path that it has, the way that is being recorded, and that it is.
#include "editor/core/core.h"
#include "editor/stage/base.h"
#include "editor/stage/hold.h"
#include "editor/stage/overlays.h"
#include "editor/stage/rigs.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { MARGIN = 12, HEIGHT = 22, PAD = 8, DOT = 10, MAX_POINTS = 256 };

/// In the upper right corner, below the caption.
static void show_sign(struct core *core, const struct document *document, bool runs, const char *text)
{
    const struct rect stage = core->layout.stage;
    const float width = ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, text)) + DOT + 3 * PAD;
    const struct rect sign = {stage.x + stage.w - MARGIN - width,
                              stage.y + fmaxf(MARGIN, caption_height(stage, document)), width, HEIGHT};
    const struct rect dot = {sign.x + PAD, sign.y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
    drawlist_rounded(&core->list, sign, HEIGHT / 2.0f, theme()->panel);
    if (runs) {
        drawlist_rounded(&core->list, dot, DOT / 2.0f, theme()->error);
    } else {
        drawlist_rounded_line(&core->list, dot, DOT / 2.0f, 1.5f, theme()->error);
    }
    drawlist_text(&core->list, dot.x + DOT + PAD, sign.y + HEIGHT - 7, FONT_LABEL_BOLD, THEME_TEXT_NORMAL,
                  theme()->error, text);
}

/// The way so far, where the hand took the base at each sample.
static void show_way(const struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct record *record = &stage->record;
    const int tail = stage->hold.tail, step = record->count / MAX_POINTS + 1;
    float points[MAX_POINTS][2];
    int count = 0;
    for (int i = 0; i < record->count; i += step) {
        float place[3];
        for (int k = 0; k < 3; k++) {
            const struct param *param = &document_tail(world->document, tail)->position[k];
            double value = param->value;
            if (param->track >= 0) value = base_value(world, tail, k, record->first + i);
            place[k] = (float)(value + record->way[k][i]);
        }
        if (!stage_project_point(stage, core->layout.stage, place, points[count++])) return;
    }
    if (count > 1) drawlist_line(&core->list, (const float *)points, count, 2, theme()->error);
}

void record_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const bool is_held = body_is_held(core);
    const int tail = is_held ? stage->hold.tail : core->hover.tail;
    const struct tail *shown = is_held || core->hover.kind == HOVER_BODY ? document_tail(document, tail) : NULL;
    bool moves = false;
    for (int k = 0; shown && k < 3; k++) moves |= shown->position[k].track >= 0;
    if (moves && !core->overlays.trail)
        path_show(stage, core, world, TRAIL_OF_BODY,
                  (struct rig_point){document_find_rig(document, RIG_TAIL, tail), POINT_BASE});
    if (is_held && stage->record.running) {
        char text[32];
        show_way(stage, core, world);
        snprintf(text, sizeof text, "REC %.1f s", stage->record.count / (document->fps * document->substeps));
        show_sign(core, document, true, text);
    } else if (core->record_armed && document_tail(document, 0)) {
        show_sign(core, document, false, "Drag the body to record it");
    }
}
