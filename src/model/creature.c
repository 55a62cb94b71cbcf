/// Meshes the fox: the more of them a scene has, the coarser.
#include "model/creature.h"

static const struct level {
    int animals;           ///< up to how many
    float cell, tolerance; ///< of the torso, see mesh_torso()
    int rings, segments;   ///< of the tail
} levels[CREATURE_LEVELS] = {
    {1, 0.030f, 0.0028f, 84, 40},
    {2, 0.044f, 0.0036f, 68, 24},
    {4, 0.070f, 0.0120f, 52, 15},
    {8, 0.100f, 0.0500f, 33, 8},
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
