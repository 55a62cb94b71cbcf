/// What commands report: a scene's solution, a glTF file's contents, progress and Ctrl+C.
#ifndef COMMANDS_REPORT_H
#define COMMANDS_REPORT_H

#include "rig/models.h"
#include "scene/evaluate.h"
#include <stdbool.h>
#include <stdio.h>

/// Prints warnings: splines that needed more than a plain solve, unmet pins and floors, and limits that those override.
void solution_warnings(const struct document *document, const struct evaluation *evaluation, const char *path,
                       FILE *out);

/// Prints a glTF character's clips, bones and nodes as a tree, possible chains, and what is not shown.
void contents_print(const struct imported *imported);

// Progress and Ctrl+C of long commands.

/// Makes Ctrl+C end the program at once with an error text, exit status ERROR_ENVIRONMENT and no partly written files. For commands without
/// other cleanup; others check process_was_told_to_end().
void progress_end_when_interrupted(void);

/// Shows the progress that base/progress.h reports; `lines` as below.
void progress_show_stages(bool lines);

struct progress {
    double started; ///< clock_now() at the start
    bool lines;     ///< without a terminal prints ten lines; false: none
    // private
    double shown;
    long done;
    const char *doing; ///< NULL: "simulating" or "exporting frames"
};

/// After one second shows on a terminal how many frames are done and the time left. Clears the line at the end.
void progress_show(struct progress *progress, long done, long total);

/// Clears the line of work that ends early.
void progress_clear(const struct progress *progress);

#endif
