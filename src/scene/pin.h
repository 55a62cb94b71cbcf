/// A pin: at one frame, a point of a rig is to be at a place. All splines that drive the rig are solved through it.
#ifndef SCENE_PIN_H
#define SCENE_PIN_H

struct json_t;

enum { SCENE_MAX_PINS = 1024 }; ///< over all rigs together

struct pin {
    double frame;         ///< as written; may be fractional
    int point;            ///< of a character: a vertex of its model; of a tail or chain: a joint, whose end it is
    double to[3];         ///< metres of the world
    unsigned id;          ///< unique among the document's knots and pins, kept through edits and undo; not saved
    struct json_t *extra; ///< unknown keys of the file, owned by the document, or NULL
};

#endif
