/// Knots as text, for the clipboard: JSON as in a scene file's "knots", and CSV from elsewhere.
#ifndef SCENE_KNOTS_H
#define SCENE_KNOTS_H

#include "scene/document.h"
#include <stddef.h>

/// Knots outside a document, without ids and unknown keys.
struct knot_list {
    struct knot *knots; ///< in the order of the text
    char **splines;     ///< names of the splines that they are of; each, and all of it, may be NULL
    int count;
};

/// A JSON array with one knot a line, as in a scene file; where it is known, "spline" says which one it is of. The caller frees
/// it.
char *knots_print(const struct knot_list *list);

/// Reads what knots_print() writes, an object with "knots" (a scene file's spline), or CSV lines frame,value[,slope[,stiffness[,im]]], the value `still` for
/// a still knot, also with semicolons or tabs, and then with decimal commas; blank lines and `#` comments are skipped. Under a header, columns go by name; frame and value
/// are the first and second column if it does not name them. If there are no knots, returns false with a
/// sentence "name:line: …: expected …, got …" and an empty list.
bool knots_parse(const char *name, const char *text, struct knot_list *list, struct error *error);

void knot_list_free(struct knot_list *list);

#endif
