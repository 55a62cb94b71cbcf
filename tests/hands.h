/// A language of hands: what a user does with mouse and keys, and what is so then. Steps are divided by ';'.
///
///     hands(s, "pull knot(sway,1) 2f -20; sway.1.frame 14; key Escape; kept");
///
/// Does. T: a target of replays such as knot(sway,1), or a widget of the inspector such as preset.cat or low_limit.
///   point T; hover T; at X Y   hover and at: and shows a frame
///   press [T]; release         the left button
///   click [T]; again [T]       again: the second click of a double-click
///   tap TEXT                   clicks on what is drawn
///   drag DX DY [N]             in N events (4), each with a frame; 2f: as wide as two frames; 0.5v: as high as a value of 0.5
///   pull T DX DY [N]; carry T DX DY [N]    press and drag; carry: and release
///   box T T                    drags from one to the other
///   slide T VALUE              a slider's handle; the button stays down
///   with [MODS]                held from now on by pointer and buttons
///   key K ...; hold K; let K   K: Z, Ctrl+Shift+Z, or 3*Alt+Left; let: releases it
///   tab T                      Tab until T has the focus
///   type TEXT; paste [TEXT]; enter T TEXT  paste: what was copied, else TEXT; enter: types over a number
///   wheel N [TIMES]; wait [N]; pass T; seek F    wait: N frames (1); pass: a picture after T seconds; seek: to frame F
///   more [off]                 of the inspector
///   keep; keep NAME            remembers the document's text and curves, as the first steps do; or a number for `is NAME kept+1`
/// Does, as the app or its window.
///   asks R [PATH]; answer R [REFUSAL]      the app was asked for R since the last time; has done it or not. R: save-as, nothing and
///                                          others in hands.c
///   path PATH; tell TEXT; opened; close; offer; welcome    close: the window; offer: of unsaved work
/// Is so.
///   kept; once                 the text is the one remembered; differs from it by one step of undo
///   undone                     undo goes back to it
///   saves TEXT; omits TEXT     the text has TEXT or not; ' in it stands for "
///   steady E                   curves are as they were within E
///   said [TEXT]; says TEXT; error TEXT     the status line has TEXT (said: nothing), is TEXT, has it as an error
///   label [TEXT]               what undo would undo
///   shows TEXT; hides TEXT     is drawn or not
///   mentions TEXT; ignores TEXT    is a part of what is drawn or not
///   finds T; lacks T           a target
///   NAME N ... [~E]            a number, within E (1e-9), or that of another name; after > or < or ! it is more, less, another one
///   is NAME TEXT; is NAME N [~E]   the same, but exactly; also of texts and of PATHs in the document's text, such as
///                              splines.0.knots.# (how many); `nothing`: there is none
/// Numbers: sway.1.frame, of a knot; sway.frame, of all its knots; sway.knots; sway.frequency and other parameters; sway@30, its curve on a
/// frame; selected, active and others in hands.c.
#ifndef TESTS_HANDS_H
#define TESTS_HANDS_H

#include "panel_session.h"
#include "shown.h"

/// What is drawn: EACH_DRAWN(c, s->editor) { … c->kind … }.
#define EACH_DRAWN(c, editor)                                                                                        \
    for (const struct draw_command *c = drawn_by(editor)->commands, *end_##c = c + drawn_by(editor)->count;          \
         c < end_##c; c++)

/// Plays the steps; fails with the first that is not so.
void hands(struct session *s, const char *steps, ...) __attribute__((format(printf, 2, 3)));

/// A number that `is` knows; NaN: there is none.
double number(struct session *s, const char *name);

/// A test that is nothing but steps: WALK(name, session_open(s, scene), "…").
#define WALK(name, opens, ...)                                                                                       \
    SESSION_TEST(name, opens) { hands(s, __VA_ARGS__); }

#endif
