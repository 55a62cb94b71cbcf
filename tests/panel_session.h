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

/// The id of a widget in sight; 0: none.
static inline uint32_t panel_id(struct session *session, const char *name)
{
    float x, y;
    return widget_at(session->editor, name, &x, &y) ? inspector_of(session->editor)->found : 0;
}

/// Opens every section of the inspector.
static inline void panel_unfold(struct session *session)
{
    static const char *const sections[] = {"feel",     "knot",   "spline",    "rigs",  "model",   "tail", "character",
                                           "advanced", "limits", "variation", "scene", "history", "pins"};
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

#endif
