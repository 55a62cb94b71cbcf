/// A meadow in a scene: reeds that all swing by one spline, each by a variation of its own.
#ifndef SCENE_MEADOW_RIG_H
#define SCENE_MEADOW_RIG_H

enum { MEADOW_MAX_REEDS = 4096 };

struct meadow_rig {
    int spline;
    int count;        ///< reeds, 1 … MEADOW_MAX_REEDS
    int seed;         ///< of their places and variations
    double area[2];   ///< metres along x and z, round the origin
    double height;    ///< of a reed, metres
    double variation; ///< amount of each reed's
    double lag, gain; ///< degrees a joint
};

#endif
