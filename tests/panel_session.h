/// For tests of inspector and dialogs, besides session.h: widgets by name, and typing.
#ifndef TESTS_PANEL_SESSION_H
#define TESTS_PANEL_SESSION_H

#include "questions.h"
#include "session.h"

#include "rig/models.h"

/// Opens a scene in a window of this size.
static inline void panel_open(struct session *session, const char *scene, float width, float height)
{
    session_open(session, scene);
    editor_resize(session->editor, width, height, 1);
    session_frame(session);
}

/// The same with the characters' models, in a window high enough for all sections.
static inline struct models *panel_open_models(struct session *session, const char *scene)
{
    panel_open(session, scene, 1280, 1500);
    struct models *models = session->work.models;
    assert_done(models_update(models, session->document, &error));
    editor_open(session->editor, &session->world);
    return models;
}

/// Splines for inspector tests: keyed, a cubic, and one whose frequency follows the cubic.
#define PANEL_SPLINES                                                                                                \
    "{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0},"             \
    "  {\"frame\": 36, \"value\": 1}, {\"frame\": 60, \"value\": -0.5}]},"                                           \
    "{\"name\": \"pace\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 90, "           \
    "\"value\": 2}]},"                                                                                               \
    "{\"name\": \"lift\", \"frequency\": {\"spline\": \"pace\"}, \"damping\": 0.2, \"knots\": [{\"frame\": 10, "     \
    "\"value\": 1}]}"

/// Sends characters with their keys, as a window does.
static inline void panel_type(struct session *session, const char *text)
{
    while (*text) {
        uint32_t c = utf8_next(&text);
        int key = c >= 'a' && c <= 'z' ? (int)c - 32 : c < 0x7F ? (int)c : 0;
        session_hold(session, key, ACTION_PRESS);
        session_send(session, (struct event){.kind = EVENT_TEXT, .codepoint = c});
        session_hold(session, key, ACTION_RELEASE);
    }
    session_frame(session);
}

/// Whether the inspector shows the widget.
static inline bool panel_shows(struct session *session, const char *name)
{
    float x, y;
    return widget_at(session->editor, name, &x, &y);
}

/// The id of a widget in sight; 0: none.
static inline uint32_t panel_id(struct session *session, const char *name)
{
    return panel_shows(session, name) ? inspector_of(session->editor)->found : 0;
}

/// Presses a widget of the inspector and keeps the button down.
static inline void panel_press(struct session *session, const char *name, int clicks)
{
    float x, y;
    if (!widget_at(session->editor, name, &x, &y)) {
        fail_msg("the inspector does not show %s", name);
    }
    session_move(session, x, y);
    session_press(session, BUTTON_LEFT, clicks);
}

static inline void panel_click(struct session *session, const char *name)
{
    panel_press(session, name, 1);
    session_release(session, BUTTON_LEFT);
}

/// Double-clicks a number and types over it.
static inline void panel_enter(struct session *session, const char *name, const char *text)
{
    panel_press(session, name, 2);
    session_release(session, BUTTON_LEFT);
    panel_type(session, text);
    session_key(session, KEY_ENTER, 0);
}

/// Drags a slider's handle to a value and keeps the button down.
static inline void panel_drag(struct session *session, const char *name, double value)
{
    char target[192];
    float x, y;
    panel_press(session, name, 1);
    snprintf(target, sizeof target, "%s,%.17g", name, value);
    assert_true(widget_at(session->editor, target, &x, &y));
    session_move(session, x + 3, y); // makes it a drag even if the handle is already there
    session_move(session, x, y);
    session_frame(session);
}

static inline void panel_release(struct session *session) { session_release(session, BUTTON_LEFT); }

/// Drags a widget by (dx, dy) in `steps` events and releases it.
static inline void panel_pull(struct session *session, const char *name, float dx, float dy, int steps)
{
    panel_press(session, name, 1);
    session_drag(session, dx, dy, steps);
    panel_release(session);
}

/// Opens every section of the inspector.
static inline void panel_unfold(struct session *session)
{
    static const char *const sections[] = {"feel",   "knot",      "splines",   "spline",   "rigs",
                                           "model",  "tail",      "character", "advanced", "poles",
                                           "limits", "variation", "scene",     "history",  "pins"};
    for (size_t i = 0; i < sizeof sections / sizeof sections[0]; i++) {
        char name[32];
        snprintf(name, sizeof name, "section.%s", sections[i]);
        unfold(session->editor, name);
    }
    session_frame(session);
}

/// The app's answer to the oldest request of a kind.
static inline void panel_answer(struct session *session, enum request_kind kind, bool ok, const char *text)
{
    editor_answer(session->editor, &(struct request){.kind = kind}, ok, text);
}

/// Whether the editor draws this text uncut.
static inline bool session_shows(const struct session *s, const char *text)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        if (c->kind == DRAW_TEXT && c->clip.w > 0 && strcmp(list->text + c->first, text) == 0) return true;
    }
    return false;
}

#endif
