/// A frame of the open document: edit, solve, pose, show.
#include "app/table.h"
#include "base/progress.h"
#include "rig/posing.h"
#include "scene/load.h"

static double since(double start) { return 1e6 * (clock_now() - start); }

static void solve(struct table *table, struct frame_row *row)
{
    struct evaluation *evaluation = &table->evaluation;
    row->edited = !evaluation_is_of(evaluation, table->document);
    evaluation->models = models_source(table->models);
    evaluation_update(evaluation, table->document, table->editor->core.look == LOOK_CUBIC);
    row->solver = evaluation_solver(evaluation);
    row->splines_solved = evaluation->solved_splines;
    row->samples = evaluation->solved_samples;
    row->knots = evaluation->solved_knots;
}

/// Reads the models of a document that is new, restored by undo, or has other models since the last edit.
static void read_models(struct table *table)
{
    struct error error;
    if (!table->models) return;
    const bool is_new = table->models_serial != table->document->serial;
    if (!is_new && models_suit(table->models, table->document)) return;
    table->models_serial = table->document->serial;
    if (is_new) {
        if (!scene_read_paint(table->document, &error)) core_message(&table->editor->core, true, "%s", error.text);
        if (!history_is_open(table->history)) history_amend(table->history);
    }
    if (!models_update(table->models, table->document, &error))
        core_message(&table->editor->core, true, "%s", error.text);
}

void table_edit(struct table *table, double dt, struct frame_row *row)
{
    const double start = clock_now();
    editor_advance(table->editor, dt);
    row->edit_us = since(start);
}

void table_solve(struct table *table, struct frame_row *row)
{
    read_models(table);
    if (table->models) models_follow(table->models, table->document);
    const double start = clock_now();
    solve(table, row);
    row->solve_us = since(start);
}

void table_pose(struct table *table, struct frame_row *row)
{
    const double start = clock_now();
    editor_pose(table->editor);
    row->pose_us = since(start);
}

void table_show(struct table *table, struct frame_row *row)
{
    const double start = clock_now();
    editor_show(table->editor);
    row->pose_us += since(start);
}

void table_free(struct table *table)
{
    evaluation_free(&table->evaluation);
    history_destroy(table->history);
    document_destroy(table->document);
    models_destroy(table->models);
    editor_destroy(table->editor);
}
