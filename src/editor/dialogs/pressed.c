/// Shows an audience the pressed keys and buttons in a fading pill. A demo also shows a pointer and captions.
#include "editor/core/command.h"
#include "editor/dialogs/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double HOLD = 1.4, FADE = 0.35; ///< seconds after the release
static const double GLIDE = 0.08;            ///< seconds that the demo's pointer lags
static const float DRAG_FROM = 3;            ///< logical pixels; shorter movements are clicks
enum { HEIGHT = 36, PAD = 18, MARGIN = 14, GAP = 8 };

/// Shows a word after its modifiers. Repeats are counted.
static void tell(struct pressed *pressed, unsigned mods, const char *word, bool counts)
{
    char text[sizeof pressed->text];
    if (!word) return;
    snprintf(text, sizeof text, "%s%s%s%s", mods & MOD_CTRL ? "Ctrl + " : "", mods & MOD_SHIFT ? "Shift + " : "",
             mods & MOD_ALT ? "Alt + " : "", word);
    const bool again = counts && pressed->seconds > 0 && strcmp(text, pressed->text) == 0;
    pressed->times = again ? pressed->times + 1 : 1;
    pressed->seconds = HOLD + FADE;
    memcpy(pressed->text, text, sizeof text);
}

static void note_button(struct pressed *pressed, const struct event *event)
{
    static const char *const clicks[] = {
        [BUTTON_LEFT] = "click", [BUTTON_RIGHT] = "right-click", [BUTTON_MIDDLE] = "middle click"};
    pressed->is_down = event->action == ACTION_PRESS;
    pressed->is_drag = false;
    if (!pressed->is_down) return;
    pressed->button = event->button;
    pressed->x = event->x;
    pressed->y = event->y;
    tell(pressed, event->mods, event->clicks == 2 ? "double-click" : clicks[event->button], true);
}

static void note_pointer(struct pressed *pressed, const struct event *event)
{
    static const char *const drags[] = {
        [BUTTON_LEFT] = "drag", [BUTTON_RIGHT] = "right drag", [BUTTON_MIDDLE] = "middle drag"};
    if (!pressed->is_down || pressed->is_drag) return;
    pressed->is_drag = maths_hypotf(event->x - pressed->x, event->y - pressed->y) > DRAG_FROM;
    if (pressed->is_drag) tell(pressed, event->mods, drags[pressed->button], false);
}

void dialogs_note(struct dialogs *dialogs, const struct event *event)
{
    struct pressed *pressed = &dialogs->pressed;
    if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE)
        tell(pressed, event->mods, command_key_name(event->key), true);
    if (event->kind == EVENT_WHEEL) tell(pressed, event->mods, "wheel", false);
    if (event->kind == EVENT_BUTTON) note_button(pressed, event);
    if (event->kind == EVENT_POINTER) note_pointer(pressed, event);
    if (event->kind == EVENT_CAPTION) {
        pressed->is_demo = true;
        snprintf(dialogs->caption, sizeof dialogs->caption, "%s", event->text);
    }
}

void dialogs_advance(struct dialogs *dialogs, const struct core *core, double dt)
{
    const float share = (float)(1 - maths_exp(-dt / GLIDE));
    struct pressed *pressed = &dialogs->pressed;
    pressed->pointer[0] += share * (core->pointer_x - pressed->pointer[0]);
    pressed->pointer[1] += share * (core->pointer_y - pressed->pointer[1]);
    if (!pressed->is_down) pressed->seconds = fmax(pressed->seconds - dt, 0);
}

static bool is_shown(const struct dialogs *dialogs, const struct core *core)
{
    return core->presenter.on || dialogs->pressed.is_demo;
}

bool dialogs_want_frames(const struct dialogs *dialogs, const struct core *core)
{
    return is_shown(dialogs, core) && dialogs->pressed.seconds > 0;
}

/// A pill centred in the free part of the stage.
static void show_pill(struct core *core, float bottom, const char *text, float alpha, uint32_t color)
{
    const struct rect open = core->layout.open;
    const float most = fmaxf(open.w - 2 * MARGIN, 2 * PAD);
    const float w = fminf(ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_TITLE, text)) + 2 * PAD, most);
    const struct rect pill = {roundf(open.x + (open.w - w) / 2), roundf(bottom - HEIGHT), w, HEIGHT};
    const float y = roundf(pill.y + (HEIGHT + font_cap_height(FONT_LABEL_BOLD, THEME_TEXT_TITLE)) / 2);
    drawlist_rounded(&core->list, pill, HEIGHT / 2.0f, theme_fade(theme()->panel, 0.92f * alpha));
    drawlist_rounded_line(&core->list, pill, HEIGHT / 2.0f, 1, theme_fade(theme()->control, alpha));
    drawlist_text_fit(&core->list, pill.x + PAD, y, w - 2 * PAD + 1, FONT_LABEL_BOLD, THEME_TEXT_TITLE,
                      theme_fade(color, alpha), text);
}

/// The demo's pointer, ringed while a button is down.
static void show_pointer(const struct pressed *pressed, struct core *core)
{
    const float x = pressed->pointer[0], y = pressed->pointer[1];
    const float arrow[8] = {x, y, x, y + 17, x + 12, y + 12, x, y};
    if (pressed->is_down) drawlist_circle(&core->list, pressed->pointer, 12, 2, theme()->accent);
    drawlist_convex(&core->list, arrow, 3, theme()->text);
    drawlist_line(&core->list, arrow, 4, 1, theme()->panel);
}

void dialogs_show_input(const struct dialogs *dialogs, struct core *core)
{
    const struct pressed *pressed = &dialogs->pressed;
    const struct message *message = &core->message;
    float bottom = core->layout.open.y + core->layout.open.h - MARGIN;
    char text[sizeof pressed->text + 16];
    if (!is_shown(dialogs, core)) return;
    if (dialogs->caption[0]) {
        show_pill(core, bottom, dialogs->caption, 1, theme()->text);
        bottom -= HEIGHT + GAP;
    }
    if (pressed->seconds > 0) {
        snprintf(text, sizeof text, pressed->times > 1 ? "%s ×%d" : "%s", pressed->text, pressed->times);
        show_pill(core, bottom, text, (float)fmin(pressed->seconds / FADE, 1), theme()->accent);
        bottom -= HEIGHT + GAP;
    }
    if (message->text[0] && core->presenter.on && core->presenter.below == 0) // the status line is hidden
        show_pill(core, bottom, message->text, 1, message->is_error ? theme()->error : theme()->text);
    if (pressed->is_demo) show_pointer(pressed, core);
}
