/// The faces of a form in a .usda file, and how they look. Private to src/export.
#ifndef EXPORT_USDA_FORM_H
#define EXPORT_USDA_FORM_H

#include "export/usda_look.h"

/// What faces a form has, polygons where its mesh had some; by what they are written.
struct usda_form {
    const struct form *form;
    const char *rig; ///< name of its prim
    FILE *out;
    char (*materials)[FORM_NAME]; ///< what they are called; NULL: it has none
};

/// Writes the materials and their pictures. False with a sentence; usda_form_close() anyway.
bool usda_form_open(struct usda_form *form, struct shot *shot, struct error *error);
void usda_form_close(struct usda_form *form);

/// Writes faces, colours and texture coordinates of the mesh; then which faces have which material.
void usda_form_faces(const struct usda_form *form);
void usda_form_subsets(const struct usda_form *form);

#endif
