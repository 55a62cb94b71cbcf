/// The document's own file where another program, or a second window, has written it: who saves next must not do so unaware.
/// Internal to src/app.
#ifndef APP_THEIRS_H
#define APP_THEIRS_H

#include "base/path.h"
#include "base/stamp.h"

struct app;

struct own_file {
    char path[PATH_LIMIT];
    struct file_stamp stamp; ///< when it was read or written last
    struct file_stamp asked; ///< what the user was asked about at the window's focus
};

/// The document and its own file say the same now, or the user has seen what is in it.
void theirs_note(struct app *app);

/// Whether the file is another one than the document came from.
bool theirs_differs(struct app *app);

/// The window has the focus again: asks what to do about a changed file, once for each change.
void theirs_look(struct app *app);

#endif
