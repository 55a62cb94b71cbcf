/// A material of a .usda file, and the file of its texture. Private to src/export.
#ifndef EXPORT_USDA_LOOK_H
#define EXPORT_USDA_LOOK_H

#include "export/shot.h"
#include "export/usda_text.h"

/// A texture: which file, and what happens past its edges.
struct usda_texture {
    char file[PATH_LIMIT]; ///< "./walk_textures/coat_0.png", or empty: none
    const char *wrap[2];   ///< "repeat", "clamp" or "mirror"
};

struct usda_look {
    const char *rig, *name;             ///< of the prims
    float color[4];                     ///< base colour, linear
    const struct usda_texture *texture; ///< NULL: the colours of the vertices, which hold the material's own
    bool is_blended, shines, is_plain;  ///< is_plain: `color` alone, whatever colours vertices have
    float cutoff;                       ///< opacity below which nothing is drawn; 0: all is
    double metallic, roughness;         ///< where it shines
};

/// A picture that goes into a file beside the .usda.
struct usda_picture {
    const char *stem; ///< of its name
    int number;
    const unsigned char *at; ///< PNG or JPEG
    size_t size;
};

/// Writes a picture's file, into a folder called as the .usda. False with a sentence.
bool usda_write_picture(struct shot *shot, const struct usda_picture *picture, char file[PATH_LIMIT],
                        struct error *error);

/// Writes the Material.
void usda_write_look(FILE *out, const struct usda_look *look);

/// Begins the GeomSubset of the faces that have a material (NULL: none), up to its list of them; usda_end_subset() ends that.
void usda_begin_subset(FILE *out, int number);
void usda_end_subset(FILE *out, const char *rig, const char *material);

#endif
