/// An editor without a window, for tests: a document with history and solution, and simulated mouse and keyboard.
#ifndef TESTS_SESSION_H
#define TESTS_SESSION_H

#include "documents.h"
#include "questions.h"

#include "app/state.h"
#include "base/file.h"
#include "ui/font.h"
#include <ctype.h>

struct session {
    struct workspace work;
    struct editor_world world;
    struct document *document; ///< from `work`, like the next two
    struct history *history;
    struct editor *editor;
    struct request asked; ///< the last request that no test has taken
    float x, y;           ///< pointer
    unsigned mods;        ///< of pointer and buttons
    bool finger;          ///< is the pointer
    char **saved;         ///< texts returned by session_saved()
    int saved_count;
    const char *kept; ///< the text that hands() keeps
};

/// Keeps a request for the test, which answers it later.
static inline void session_carry_out(void *user, const struct request *request)
{
    ((struct session *)user)->asked = *request;
}

/// Takes the last request.
static inline struct request session_asked(struct session *session)
{
    const struct request asked = session->asked;
    session->asked.kind = REQUEST_NONE;
    session->asked.path[0] = '\0';
    return asked;
}

static inline void session_send(struct session *session, struct event event)
{
    editor_event(session->editor, &event);
}

static inline void session_close(struct session *session)
{
    while (session->saved_count > 0) free(session->saved[--session->saved_count]);
    free(session->saved);
    workspace_free(&session->work);
}

/// A frame of 1/60 s; requests are left to the test.
static inline void session_frame(struct session *session)
{
    struct frame_row row = {0};
    workspace_edit(&session->work, 1.0 / 60, &row);
    workspace_solve(&session->work, &row);
    workspace_pose(&session->work, &row);
    workspace_show(&session->work, &row);
    assert_ids(session->editor);
}

static inline void session_move(struct session *session, float x, float y)
{
    session->x = x;
    session->y = y;
    session_send(
        session,
        (struct event){.kind = EVENT_POINTER, .x = x, .y = y, .mods = session->mods, .finger = session->finger});
}

/// Moves the pointer by (dx, dy) in `steps` events, with a frame after each.
static inline void session_drag(struct session *session, float dx, float dy, int steps)
{
    float x = session->x, y = session->y;
    for (int i = 1; i <= steps; i++) {
        float share = (float)i / (float)steps;
        session_move(session, x + dx * share, y + dy * share);
        session_frame(session);
    }
}

/// Position of an editor_target(); fails the test if there is none.
static inline void session_where(const struct session *session, const char *target, float xy[2])
{
    assert_done(editor_target(session->editor, target, &xy[0], &xy[1], &error));
}

/// Moves the pointer to a target.
static inline void session_point(struct session *session, const char *target)
{
    float xy[2];
    session_where(session, target, xy);
    session_move(session, xy[0], xy[1]);
}

static inline void session_hover(struct session *session, const char *target)
{
    session_point(session, target);
    session_frame(session);
}

static inline void session_button(struct session *session, enum event_button which, enum event_action action,
                                  int clicks)
{
    session_send(session, (struct event){.kind = EVENT_BUTTON,
                                         .button = which,
                                         .action = action,
                                         .clicks = clicks,
                                         .finger = session->finger,
                                         .x = session->x,
                                         .y = session->y,
                                         .mods = session->mods});
}

static inline void session_press(struct session *session, enum event_button which, int clicks)
{
    session_button(session, which, ACTION_PRESS, clicks);
}

static inline void session_release(struct session *session, enum event_button which)
{
    session_button(session, which, ACTION_RELEASE, 1);
    session_frame(session);
}

/// Drags a target by (dx, dy) in `steps` events and keeps the button down.
static inline void session_pull(struct session *session, const char *target, float dx, float dy, int steps)
{
    session_point(session, target);
    session_press(session, BUTTON_LEFT, 1);
    session_drag(session, dx, dy, steps);
}

/// The same, and releases it.
static inline void session_carry(struct session *session, const char *target, float dx, float dy, int steps)
{
    session_pull(session, target, dx, dy, steps);
    session_release(session, BUTTON_LEFT);
}

/// The last of `clicks` clicks at the pointer.
static inline void session_click_here(struct session *session, int clicks)
{
    session_press(session, BUTTON_LEFT, clicks);
    session_release(session, BUTTON_LEFT);
}

/// A click on a target.
static inline void session_click(struct session *session, const char *target)
{
    session_point(session, target);
    session_click_here(session, 1);
}

static inline void session_click_with(struct session *session, unsigned mods, const char *target)
{
    session->mods = mods;
    session_click(session, target);
    session->mods = 0;
}

static inline void session_wheel(struct session *session, float notches)
{
    session_send(
        session,
        (struct event){.kind = EVENT_WHEEL, .dy = notches, .x = session->x, .y = session->y, .mods = session->mods});
    session_frame(session);
}

static inline void session_hold(struct session *session, int key, enum event_action action)
{
    session_send(session, (struct event){.kind = EVENT_KEY, .key = key, .action = action});
}

/// Presses and releases a key, then runs a frame.
static inline void session_key(struct session *session, int key, unsigned mods)
{
    session_send(session, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    session_send(session, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
    session_frame(session);
}

/// Presses a key that types a character, which may differ from the key's name in other layouts.
static inline void session_strike(struct session *session, int key, unsigned mods, uint32_t typed)
{
    session_send(session, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    session_send(session, (struct event){.kind = EVENT_TEXT, .codepoint = typed});
    session_send(session, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
    session_frame(session);
}

/// Presses the keys for small letters, digits and punctuation.
static inline void session_type(struct session *session, const char *text)
{
    for (; *text; text++) session_strike(session, toupper((unsigned char)*text), 0, (unsigned char)*text);
}

/// The document's canonical text, valid as long as the session.
static inline const char *session_saved(struct session *session)
{
    const size_t count = (size_t)++session->saved_count;
    session->saved = realloc(session->saved, count * sizeof *session->saved);
    assert_non_null(session->saved);
    return session->saved[count - 1] = text_of_document(session->document);
}

static inline void assert_saved(const struct session *session, const char *expected)
{
    assert_prints(session->document, expected);
}

/// The document differs from `original`; one undo restores that byte by byte, one redo the change.
static inline void assert_one_step(struct session *session, const char *original)
{
    const char *changed = session_saved(session);
    assert_string_not_equal(changed, original);
    session_key(session, 'Z', MOD_CTRL);
    assert_saved(session, original);
    session_key(session, 'Z', MOD_CTRL | MOD_SHIFT);
    assert_saved(session, changed);
}

/// The document of a scene in which ' may be written for " and <10 0.5> for a knot with this frame and value.
static inline struct document *document_of_scene(const char *scene)
{
    char *json = malloc(6 * strlen(scene) + 1), *end = json;
    bool in_string = false, in_knot = false;
    assert_non_null(json);
    for (; *scene; scene++) {
        const char *more = *scene == '\'' ? "\"" : *scene == '<' ? "{\"frame\": " : *scene == '>' ? "}" : NULL;
        in_string ^= *scene == '"';
        in_knot = *scene != '>' && (in_knot || *scene == '<');
        if (in_knot && *scene == ' ') more = ", \"value\": ";
        if (more && !in_string)
            end = stpcpy(end, more);
        else
            *end++ = *scene;
    }
    *end = '\0';
    struct document *document = document_of_text(json);
    free(json);
    return document;
}

/// Opens a scene given as text, as in document_of_scene(), and shows its first frame (1280×720, paused). Fails the test on errors.
static inline void session_open(struct session *session, const char *scene)
{
    memset(session, 0, sizeof *session);
    font_init();
    session->document = document_of_scene(scene);
    session->history = history_create(session->document);
    assert_non_null(session->history);
    session->editor = editor_create(&(struct editor_app){.user = session, .carry_out = session_carry_out});
    show_more(session->editor, true); // shows everything in the inspector
    session->work = (struct workspace){.editor = session->editor,
                                       .document = session->document,
                                       .history = session->history,
                                       .models = models_create()};
    session->world = workspace_world(&session->work);
    editor_open(session->editor, &session->world);
    if (playback_of(session->editor)->playing) session_key(session, KEY_SPACE, 0);
    session_frame(session);
}

/// The same with a scene's file.
static inline void session_open_file(struct session *session, const char *path)
{
    char *text;
    size_t size;
    assert_done(file_read(path, 1 << 20, &text, &size, &error));
    session_open(session, text);
    free(text);
}

/// A test in a session opened by `opens` and closed afterwards: SESSION_TEST(name, session_open(s, scene)) { … }.
#define SESSION_TEST(name, opens) TEST_OF(struct session, s, opens, session_close(s), name)

#endif
