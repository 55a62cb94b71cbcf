/// Meshes the fox: the more of them a scene has, the coarser.
#include "model/creature.h"

static const struct level {
    int animals;           ///< up to how many
    float cell, tolerance; ///< of the torso, see mesh_torso()
    int rings, segments;   ///< of the tail
} levels[CREATURE_LEVELS] = {
    {1, 0.034f, 0.0018f, 84, 40},
    {2, 0.044f, 0.0036f, 68, 24},
    {4, 0.060f, 0.0090f, 52, 15},
    {8, 0.076f, 0.0250f, 33, 8},
};

int creature_level(int animals)
{
    int level = 0;
    while (level + 1 < CREATURE_LEVELS && levels[level].animals < animals) level++;
    return level;
}

void mesh_creature(int level, struct mesh *mesh)
{
    mesh_torso(levels[level].cell, levels[level].tolerance, mesh);
    mesh_tail(levels[level].rings, levels[level].segments, mesh);
}
