/// The controls for playback at the left of the status line: play, loop, speed, auto-key; and of the view: its scale, presenting.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/playback.h"
#include "editor/core/presenter.h"
#include "editor/transport/state.h"
#include "editor/transport/transport.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>

enum {
    MARGIN = 6,
    PLAY_WIDTH = 24,
    LOOP_WIDTH = 42,
    SPEED_WIDTH = 44,
    AUTO_KEY_WIDTH = 64,
    UI_SCALE_WIDTH = 48,
    PRESENT_WIDTH = 28
};

struct rect controls_rect(const struct core *core, enum control control)
{
    static const float width[TRANSPORT_COUNT] = {PLAY_WIDTH,     LOOP_WIDTH,     SPEED_WIDTH,
                                                 AUTO_KEY_WIDTH, UI_SCALE_WIDTH, PRESENT_WIDTH};
    struct rect bar = core->layout.status, r = {bar.x + MARGIN, bar.y + 2, width[0], bar.h - 3};
    for (int i = 1; i <= (int)control; i++) {
        r.x += r.w;
        r.w = width[i];
    }
    return r;
}

static enum control control_at(const struct core *core, float x, float y)
{
    int control = 0;
    while (control < TRANSPORT_COUNT && !rect_contains(controls_rect(core, (enum control)control), x, y)) control++;
    return (enum control)control;
}

struct hover transport_hover(const struct core *core, float x, float y)
{
    static const enum hover_kind kinds[] = {HOVER_PLAY,     HOVER_LOOP,    HOVER_SPEED, HOVER_AUTO_KEY,
                                            HOVER_UI_SCALE, HOVER_PRESENT, HOVER_NONE};
    return (struct hover){.kind = kinds[control_at(core, x, y)]};
}

bool transport_event(struct core *core, const struct editor_world *world, const struct event *event)
{
    enum control control = control_at(core, event->x, event->y);
    if (event->kind == EVENT_WHEEL) {
        const bool turns = (control == TRANSPORT_SPEED || control == TRANSPORT_UI_SCALE) && event->dy != 0;
        if (turns && control == TRANSPORT_UI_SCALE) {
            core_request_number(core, REQUEST_UI_SCALE, event->dy > 0 ? 1 : -1);
        } else if (turns)
            playback_change_speed(core, world, event->dy > 0 ? 1 : -1);
        return turns;
    }
    if (control == TRANSPORT_COUNT || event->button == BUTTON_MIDDLE) return false;
    bool left = event->button == BUTTON_LEFT;
    const int step = !left ? 0 : event->mods & MOD_SHIFT ? -1 : 1;
    if (control == TRANSPORT_PLAY && left) playback_toggle(core, world);
    if (control == TRANSPORT_LOOP && left) playback_toggle_loop(core, world, 0);
    if (control == TRANSPORT_AUTO_KEY && left) drag_toggle_auto_key(core, world, 0);
    if (control == TRANSPORT_SPEED) playback_change_speed(core, world, step);
    if (control == TRANSPORT_UI_SCALE) core_request_number(core, REQUEST_UI_SCALE, step);
    if (control == TRANSPORT_PRESENT && left) presenter_toggle(core, world, 0);
    return true;
}

/// A triangle while it plays, else two bars.
static void paint_play_state(struct drawlist *list, float x, float y, bool playing, bool hot)
{
    uint32_t color = playing ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    if (playing) {
        const float triangle[6] = {x, y - 5, x + 9, y, x, y + 5};
        drawlist_convex(list, triangle, 3, color);
    } else {
        drawlist_rect(list, (struct rect){x, y - 5, 3, 10}, color);
        drawlist_rect(list, (struct rect){x + 5, y - 5, 3, 10}, color);
    }
}

static void paint_word(struct core *core, struct rect r, enum font font, const char *text, bool on, bool hot)
{
    float size = font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
    uint32_t color = on ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    float x = roundf(r.x + (r.w - font_width(font, size, text)) / 2);
    float y = ui_baseline(r, font, size);
    drawlist_text(&core->list, x, y, font, size, color, text);
}

/// A screen on its foot.
static void paint_screen(struct drawlist *list, struct rect r, bool on, bool hot)
{
    const uint32_t color = on ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    const float x = roundf(r.x + (r.w - 14) / 2), y = roundf(r.y + (r.h - 12) / 2);
    drawlist_rounded_line(list, (struct rect){x, y, 14, 10}, 1.5f, 1.25f, color);
    drawlist_rect(list, (struct rect){x + 4, y + 11, 6, 1}, color);
}

float controls_show(struct core *core)
{
    const struct playback *playback = &core->playback;
    enum hover_kind hover = core->hover.kind;
    struct rect play = controls_rect(core, TRANSPORT_PLAY), loop = controls_rect(core, TRANSPORT_LOOP);
    struct rect speed = controls_rect(core, TRANSPORT_SPEED);
    char text[16];
    snprintf(text, sizeof text, "%g×", playback->speed);
    paint_play_state(&core->list, play.x + 6, play.y + play.h / 2, playback->playing, hover == HOVER_PLAY);
    paint_word(core, loop, FONT_LABEL, "Loop", playback->looping, hover == HOVER_LOOP);
    paint_word(core, speed, FONT_NUMBER, text, playback->speed != 1, hover == HOVER_SPEED);
    const struct rect auto_key = controls_rect(core, TRANSPORT_AUTO_KEY);
    paint_word(core, auto_key, FONT_LABEL, "Auto-key", core->auto_key, hover == HOVER_AUTO_KEY);
    const struct rect scale = controls_rect(core, TRANSPORT_UI_SCALE),
                      present = controls_rect(core, TRANSPORT_PRESENT);
    snprintf(text, sizeof text, "%.0f %%", 100 * core->ui_scale);
    paint_word(core, scale, FONT_NUMBER, text, core->ui_scale != 1, hover == HOVER_UI_SCALE);
    paint_screen(&core->list, present, core->presenter.on, hover == HOVER_PRESENT);
    return present.x + present.w;
}
