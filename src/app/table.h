/// The document on the table, and its part of a frame: edit, solve, pose, show. No window, no files, no GL.
#ifndef APP_TABLE_H
#define APP_TABLE_H

#include "editor/editor.h"
#include "scene/motion.h"
#include "timing/framelog.h"

/// All zero but what table_frame() works on.
struct table {
    struct editor *editor;
    struct document *document;
    struct history *history;
    struct models *models;        ///< NULL: the characters have no models
    struct motion_source motions; ///< where equilibria that follow joints are read from; zero: the models' clips
    struct evaluation evaluation;
    unsigned models_serial;   ///< of the document whose models were read last
    uint64_t solved_revision; ///< 0: nothing is solved
    bool solved_cubic;
    bool *dirty; ///< one a spline
};

/// What the app does between the parts of a frame; either may be NULL.
struct table_hooks {
    void (*advanced)(void *user); ///< the editor's requests wait for an answer
    void (*posed)(void *user);    ///< the stage is set, what is around it is not yet
    void *user;
};

static inline struct editor_world table_world(const struct table *table)
{
    return (struct editor_world){table->document, table->history, &table->evaluation, table->models};
}

/// One frame, after its events: `dt` seconds of playback, the hooks' work, and the draw list. Enters times and counts in the
/// row. false if memory is short for an edit.
bool table_frame(struct table *table, double dt, const struct table_hooks *hooks, struct frame_row *row,
                 struct error *error);

/// Frees everything on it.
void table_free(struct table *table);

#endif
