/// The document on the table, and its part of a frame: edit, solve, pose, show. No window, no files, no GL.
#ifndef APP_TABLE_H
#define APP_TABLE_H

#include "editor/editor.h"
#include "scene/evaluate.h"
#include "timing/framelog.h"

/// All zero but what a frame works on.
struct table {
    struct editor *editor;
    struct document *document;
    struct history *history;
    struct models *models; ///< NULL: the characters have no models
    struct evaluation evaluation;
    unsigned models_serial; ///< of the document whose models were read last
};

static inline struct editor_world table_world(const struct table *table)
{
    return (struct editor_world){table->document, table->history, &table->evaluation, table->models};
}

/// The parts of a frame after its events, in turn. Each enters its time and counts in the row.
/// `dt` seconds of playback, and the edits of a running drag.
void table_edit(struct table *table, double dt, struct frame_row *row);
void table_solve(struct table *table, struct frame_row *row);
void table_pose(struct table *table, struct frame_row *row);
/// The draw list.
void table_show(struct table *table, struct frame_row *row);

/// Frees everything on it.
void table_free(struct table *table);

#endif
