/// An imported character in a scene: a glTF file, which is not read here and may be missing.
#ifndef SCENE_MODEL_RIG_H
#define SCENE_MODEL_RIG_H

struct model_rig {
    char *model;        ///< the file, relative to the document's folder unless absolute
    char *clip;         ///< of its animations, the one that it plays; NULL: it stands at rest
    double position[3]; ///< metres
    double scale;       ///< times the file's metres; above 0
    double turn;        ///< degrees about world up
};

#endif
