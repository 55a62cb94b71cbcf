/// The open document and its part of a frame: edit, solve, pose, show. No window, no files, no GL.
#ifndef APP_TABLE_H
#define APP_TABLE_H

#include "editor/editor.h"
#include "scene/evaluate.h"
#include "timing/framelog.h"

/// Start from zero, with the parts that a frame needs.
struct table {
    struct editor *editor;
    struct document *document;
    struct history *history;
    struct models *models; ///< NULL: characters without models
    struct evaluation evaluation;
    unsigned models_serial; ///< of the document whose models are loaded
};

static inline struct editor_world table_world(const struct table *table)
{
    return (struct editor_world){table->document, table->history, &table->evaluation, table->models};
}

/// The steps of a frame after its events, in this order. Each adds its time and counts to the row.
/// `dt`: seconds of playback. Also applies running drags.
void table_edit(struct table *table, double dt, struct frame_row *row);
void table_solve(struct table *table, struct frame_row *row);
void table_pose(struct table *table, struct frame_row *row);
/// Builds the draw list.
void table_show(struct table *table, struct frame_row *row);

void table_free(struct table *table);

#endif
