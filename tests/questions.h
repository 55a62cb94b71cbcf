/// What a test asks about an editor, in the user's words. Tests know no other way inside, but where they test a panel itself.
#ifndef TESTS_QUESTIONS_H
#define TESTS_QUESTIONS_H

#include "near.h"

#include "editor/core/core.h"
#include "editor/curves/curves.h"
#include "editor/curves/state.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/state.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/state.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "editor/state.h"

// --- the status line and what is drawn ---

static inline const struct message *message_of(const struct editor *e) { return &e->core.message; }
static inline const char *said(const struct editor *e) { return message_of(e)->text; }
static inline bool said_error(const struct editor *e) { return message_of(e)->is_error; }
/// Says something, as the app does.
#define tell(e, ...) core_message(&(e)->core, __VA_ARGS__)

static inline void hush(struct editor *e) { e->core.message.text[0] = 0; }
/// Gives the status line its figures.
static inline void tell_figures(struct editor *e, double fps, double solve_us)
{
    static struct figures figures;
    figures = (struct figures){.fps = fps, .solve_us = solve_us, .ui_scale = 1};
    e->core.app.figures = &figures;
    e->core.app.stats = true;
}
static inline const struct tooltip *tooltip_of(const struct editor *e) { return &e->tooltip; }

/// The status line says this, among other things.
static inline void assert_said(const struct editor *e, const char *part)
{
    if (!strstr(said(e), part)) fail_msg("expected to read \"%s\" in \"%s\"", part, said(e));
}

/// The same, as an error.
static inline void assert_said_error(const struct editor *e, const char *part)
{
    assert_said(e, part);
    assert_true(said_error(e));
}

static inline struct drawlist *drawn_by(struct editor *e) { return &e->core.list; }
static inline const struct layout *layout_of(const struct editor *e) { return &e->core.view.layout; }

// --- dialogs ---

static inline struct dialog *dialog_of(const struct editor *e) { return &e->dialogs->dialog; }
/// Which one is open.
static inline enum dialog_kind asked(const struct editor *e) { return dialog_of(e)->kind; }
/// What stands in its field.
static inline const char *typed(const struct editor *e) { return dialog_of(e)->ui.text.bytes; }
static inline const char *asked_error(const struct editor *e) { return dialog_of(e)->error; }
static inline void welcome(struct editor *e) { dialogs_welcome(e->dialogs); }
static inline bool is_welcoming(const struct editor *e) { return dialogs_is_welcoming(e->dialogs); }
static inline void offer_recovery(struct editor *e, const struct recovery_offer *offer)
{
    dialogs_offer_recovery(e->dialogs, offer);
}
/// Gives the dialogs an app's folders, recent files and formats.
static inline void list_files(struct editor *e, const struct editor_app *app)
{
    e->core.app.list = app->list;
    e->core.app.recent = app->recent;
    e->core.app.format_count = app->format_count;
}
/// F1's list or the palette.
static inline struct lookup *lookup_of(const struct editor *e) { return &e->dialogs->lookup; }

// --- what keys act on ---

static inline int active(const struct editor *e) { return e->core.focus.active; }
static inline const struct spline *active_spline(const struct editor *e) { return core_active_spline(&e->core); }
static inline void activate(struct editor *e, int spline) { core_activate(&e->core, spline); }
static inline struct selection *selection_of(struct editor *e) { return &e->core.focus.selection; }
/// How many knots are.
static inline int selected(const struct editor *e) { return selected_count(&e->core); }
static inline const char *copied(const struct editor *e) { return e->core.clipboard; }
static inline struct brush *brush_of(struct editor *e) { return &e->core.focus.brush; }
/// What a command lacks, or NULL.
static inline const char *missing(const struct editor *e, unsigned needs)
{
    const char *all[NEEDS_COUNT];
    needs_missing(&e->core, all);
    return all[needs];
}
static inline bool is_dragging(const struct editor *e) { return e->core.input.drag.owner != NULL; }
/// What a drag edits, as Undo will say it; NULL: nothing.
static inline const char *dragged(const struct editor *e) { return e->core.input.drag.label; }
static inline const struct thing *hovered(const struct editor *e) { return e->core.input.hover.thing; }

static inline void undo(struct editor *e) { core_undo(&e->core, -1); }
static inline void undo_to(struct editor *e, size_t steps) { core_jump(&e->core, steps); }

// --- time and views ---

static inline struct playback *playback_of(struct editor *e) { return &e->core.view.playback; }
static inline void seek(struct editor *e, double frame) { playback_seek(&e->core, frame); }
static inline double shown_frame(const struct editor *e) { return core_frame(&e->core); }
static inline bool plays_part(const struct editor *e) { return playback_is_part(&e->core); }
static inline enum look look(const struct editor *e) { return e->core.view.look; }
static inline bool is_on(const struct editor *e, enum view_switch which) { return e->core.view.on[which]; }
static inline void set_path(struct editor *e, const char *path) { history_set_path(e->core.history, path); }
static inline const struct evaluation *solved(const struct editor *e) { return e->core.evaluation; }

// --- curves and stage ---

static inline struct plotted *plot_of(struct editor *e) { return &e->core.view.plot; }
/// A frame's place in the plot.
static inline float x_of(const struct editor *e, double frame) { return curves_x(&e->core, frame); }
static inline const struct warnings *warnings_of(const struct editor *e) { return &e->curves->warnings; }
static inline struct selection *hidden_of(struct editor *e) { return &e->core.view.hidden; }
static inline struct camera *camera_of(struct editor *e) { return &e->core.view.camera; }
/// The first strand's.
static inline const struct pose *posed(const struct editor *e) { return &e->stage->strands[0].pose; }

// --- the inspector ---

static inline struct ui *inspector_of(const struct editor *e) { return &e->inspector->ui; }
static inline struct ui_list *sections(const struct editor *e) { return &e->inspector->sections; }
static inline void unfold(struct editor *e, const char *section) { inspector_unfold(e->inspector, section); }
static inline void show_more(struct editor *e, bool more) { e->core.view.on[SWITCH_MORE] = more; }
static inline bool widget_at(const struct editor *e, const char *name, float *x, float *y)
{
    return inspector_target(e->inspector, name, x, y);
}

/// No two widgets have had one id.
static inline void assert_ids(const struct editor *editor)
{
    const struct ui *uis[] = {&editor->inspector->ui, &editor->dialogs->dialog.ui};
    for (int i = 0; i < 2; i++) {
        const struct ui_stop *twice = &uis[i]->twice;
        if (twice->id)
            fail_msg("the widget at %g, %g has another one's id", (double)twice->rect.x, (double)twice->rect.y);
    }
}

#endif
