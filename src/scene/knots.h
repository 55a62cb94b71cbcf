/// Knots as text, for the clipboard: JSON as in a scene file's "knots", and CSV from elsewhere.
#ifndef SCENE_KNOTS_H
#define SCENE_KNOTS_H

#include "scene/document.h"
#include <stddef.h>

/// Knots that no document has: ids and unknown keys are 0.
struct knot_list {
    struct knot *knots; ///< in the order of the text
    int count;
};

/// A JSON array, a knot a line, with the keys of a scene file and its frames. Freed by the caller; NULL where memory is
/// short.
char *knots_print(const struct knot *knots, int count);

/// Reads what knots_print() writes, an object with "knots" (a spline of a scene file), or CSV. false with a sentence
/// "name:line: …: expected …, got …" where it is none of them or empty; the list is then empty.
bool knots_parse(const char *name, const char *text, struct knot_list *list, struct error *error);

/// Reads CSV lines frame,value[,slope[,stiffness]]; also with semicolons or tabs, and then with decimal commas. Blank lines and
/// `#` comments are passed over. Under a header, slope and stiffness are the columns of that name; where "frame" or
/// "value" is not among the names, they are the first two.
bool knots_parse_csv(const char *name, const char *text, struct knot_list *list, struct error *error);

void knot_list_free(struct knot_list *list);

#endif
