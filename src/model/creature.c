#include "model/creature.h"

static const struct level {
    int animals; ///< up to how many
    float cell;
    int rings, segments;
} levels[CREATURE_LEVELS] = {{1, 0.027f, 80, 32}, {3, 0.048f, 75, 20}, {8, 0.070f, 50, 10}};

int creature_level(int animals)
{
    int level = 0;
    while (level + 1 < CREATURE_LEVELS && levels[level].animals < animals) level++;
    return level;
}

void mesh_creature(int level, struct mesh *mesh)
{
    mesh_body(levels[level].cell, mesh);
    mesh_tail(levels[level].rings, levels[level].segments, mesh);
}
