/// Disjoint sets: which of many numbers belong together (union by index, paths halved).
#ifndef SIMULATION_UNION_H
#define SIMULATION_UNION_H

/// The least member of i's set. parent[i] = i at the start.
static inline int union_root(int *parent, int i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline void union_join(int *parent, int i, int j)
{
    i = union_root(parent, i);
    j = union_root(parent, j);
    if (i < j) {
        parent[j] = i;
    } else {
        parent[i] = j;
    }
}

#endif
