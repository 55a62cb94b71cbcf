/// Meshes the fox: the more of them a scene has, the coarser.
#include "model/creature.h"

static const struct level {
    int animals;           ///< up to how many
    float cell, tolerance; ///< of the torso, see mesh_torso()
    int rounds;
    int rings, segments; ///< of the tail
} levels[CREATURE_LEVELS] = {
    {1, 0.030f, 0.0028f, 3, 72, 32},
    {2, 0.036f, 0.0036f, 1, 68, 24},
    {4, 0.047f, 0.0150f, 1, 48, 15},
    {8, 0.059f, 0.0000f, 0, 30, 9},
};

int creature_level(int animals)
{
    int level = 0;
    while (level + 1 < CREATURE_LEVELS && levels[level].animals < animals) level++;
    return level;
}

void mesh_creature(int level, struct mesh *mesh)
{
    const struct level *l = &levels[level];
    mesh_torso(l->cell, l->tolerance, l->rounds, mesh);
    mesh_tail(l->rings, l->segments, mesh);
}
