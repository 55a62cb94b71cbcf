/// The last export in the settings.
#ifndef APP_EXPORT_MEMORY_H
#define APP_EXPORT_MEMORY_H

#include "app/settings.h"
#include "editor/dialogs/dialog_files.h"

/// What is not in the settings is as in a new dialog. `scene` is the path of the file that is open, or "".
void export_memory_read(const struct settings *settings, const char *scene, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct request *request, const char *scene);

#endif
