/// What there is to say about a scene's pins once it is solved.
#ifndef COMMANDS_PIN_WARNINGS_H
#define COMMANDS_PIN_WARNINGS_H

#include "scene/evaluate.h"

/// Calls `tell` with a sentence for each pin that is not met, for each floor that is not, and for what of each spline they pass over.
void pin_warnings(const struct document *document, const struct evaluation *evaluation,
                  void (*tell)(void *user, const char *sentence), void *user);

#endif
