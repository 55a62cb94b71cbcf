/// What the writers of .usda share: names and arrays. Private to src/export.
#ifndef EXPORT_USDA_TEXT_H
#define EXPORT_USDA_TEXT_H

#include "export/form.h"
#include <stdio.h>

/// A name of letters, digits and "_": "up.-re" → "up_minus_re".
void usda_identifier(const char *name, char identifier[FORM_NAME]);

/// The same, made another one than the first `count` names by a number behind it.
void usda_unique(char names[][FORM_NAME], int count, const char *wanted, char name[FORM_NAME]);

/// "declaration = [(x, y, z), …]", without an end of the line.
void usda_vectors(FILE *out, const char *declaration, const float (*vectors)[3], int count);

/// Says that an array goes by vertex, with `each` elements for one; 0: it need not be said.
void usda_by_vertex(FILE *out, int each);

#endif
