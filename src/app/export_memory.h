/// The last export in the settings.
#ifndef APP_EXPORT_MEMORY_H
#define APP_EXPORT_MEMORY_H

#include "app/settings.h"
#include "editor/dialogs/dialog_files.h"

/// What is not in the settings is as in a new dialog.
void export_memory_read(const struct settings *settings, struct export_memory *memory);
void export_memory_write(struct settings *settings, const struct export_memory *memory);

#endif
