/// Long commands: how far they are, and Ctrl+C.
#ifndef COMMANDS_PROGRESS_H
#define COMMANDS_PROGRESS_H

#include <stdbool.h>

/// Lets Ctrl+C end the program at once, whatever it does: with a sentence, with ERROR_ENVIRONMENT as exit status, and without the files
/// that were being written. For commands that have nothing else to clean up; others look at
/// process_was_told_to_end().
void progress_end_when_interrupted(void);

/// Shows stages of the work that tell how far they are (base/progress.h) from now on; `lines` as below.
void progress_show_stages(bool lines);

struct progress {
    double started; ///< clock_now() when the work began
    bool lines;     ///< ten lines where standard error is no terminal; else it is then quiet
    // private
    double shown;
    long done;
    const char *doing; ///< NULL: simulating or exporting frames
};

/// Shows on a terminal how many of the frames are done and the time left, once the work has taken a second; wipes it out at the end.
void progress_show(struct progress *progress, long done, long total);

/// Wipes out what is shown, for work that ends before.
void progress_clear(const struct progress *progress);

#endif
