/// What every frame asks of a document's knots, found out once a change: a million of them take longer than a frame to look at.
#ifndef EDITOR_CORE_SURVEY_H
#define EDITOR_CORE_SURVEY_H

#include "editor/core/state.h"

/// Before what is shown: looks at all selected knots and at the active spline's values, if they have changed since.
void survey_update(struct core *core, const struct document *document);

/// Which of a spline's knots can be selected ones: those from `first` to before `end`. All of them where something has changed since.
void survey_selected(const struct core *core, const struct document *document, int spline, int *first, int *end);

/// The lowest and highest value of some knots of the active spline, at least one, from `first` to before `end`.
void survey_values(const struct core *core, const struct document *document, int first, int end, double range[2]);

#endif
