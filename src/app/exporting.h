/// The export that the Export dialog asked for, done beside the frames: a copy of the document is solved and written by a thread, films
/// are drawn picture by picture. Internal to src/app.
#ifndef APP_EXPORTING_H
#define APP_EXPORTING_H

#include "editor/editor.h"

struct app;
struct export_job;

/// The formats, in the order that the dialog lists them.
extern const struct dialog_format exporting_formats[];
extern const int exporting_format_count;

/// Begins; the answer comes once exporting_step() is done with it. False with a sentence.
bool exporting_start(struct app *app, const struct request *request, struct error *error);
/// The running one is to end, with nothing written; if there is none, nothing happens.
void exporting_stop(struct app *app);
/// Call it once a frame: goes on with the running one, and tells the editor. Under a fixed clock it ends in the frame it began in.
void exporting_step(struct app *app);
#endif
