/// Hands and eyes in words: a walk through an editor as short sentences, such as "key Ctrl+A; enter value 0.25; is splines.0.knots.1.value
/// 0.25; step". tests/walks.c has the verbs.
#ifndef TESTS_WALKS_H
#define TESTS_WALKS_H

#include "panel_session.h"
#include "shown.h"

/// Does the steps, between which there are semicolons, and fails with the one that goes wrong. printf()'s conversions are allowed in them.
__attribute__((format(printf, 2, 3))) void walk(struct session *session, const char *steps, ...);

/// A number of the document as it would be saved, such as "splines.0.knots.1.frame", or of the editor; NaN: there is none.
double number(struct session *session, const char *name);

/// A scene that is written with ' for ". Every fourth call reuses the storage.
const char *quoted(const char *scene);

/// A test of a walk in a scene that is shown in a window of this size.
#define WALK(name, scene, width, height, ...)                                                                        \
    SESSION_TEST(name, panel_open(s, quoted(scene), width, height)) { walk(s, __VA_ARGS__); }

#endif
