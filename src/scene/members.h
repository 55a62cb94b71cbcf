/// Writes the objects of a scene file, key by key. Private to src/scene.
#ifndef SCENE_MEMBERS_H
#define SCENE_MEMBERS_H

#include "scene/document.h"
#include "scene/text.h"
#include <jansson.h>

/// An object being written: `open` comes before its first member, `separator` before the others.
struct members {
    struct text *text;
    const char *open, *separator;
    bool any;
};

/// Writes a key; its value follows.
void member(struct members *members, const char *key);
void member_number(struct members *members, const char *key, double value);
void member_flag(struct members *members, const char *key, bool value);
void member_string(struct members *members, const char *key, const char *string);

/// A path of the document, for a file in `folder`.
void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                 const char *folder);

/// Whether a key of an extra object holds the unknown keys of a track instead of being one itself.
typedef bool holds_tracks(const char *key);

/// Writes the unknown keys except those that `skips` (may be NULL) says belong to tracks.
void members_extra(struct members *members, json_t *extra, holds_tracks *skips);

/// A knot on one line, with the name of its spline unless that is NULL.
void print_knot(struct text *text, const struct knot *knot, const char *spline);

/// A number, a track or a motion, for a file in `folder`; `extras` holds the unknown keys of the latter two, by `key`.
void print_param(struct text *text, const struct document *document, const struct param *param, json_t *extras,
                 const char *key, const char *folder);

/// The members of a motion.
void print_motion(struct members *members, const struct document *document, const struct param *param,
                  const char *folder);

/// The rigs as an array, with paths relative to `folder`, that of the file.
void print_rigs(struct text *text, const struct document *document, const char *folder);

/// [1, 2, 3]
void text_numbers(struct text *text, const double *values, int count);

#endif
