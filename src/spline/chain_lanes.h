/// Several chains of one filter and start, solved side by side: each in a lane of a vector, the same bits as chain_solve() gives.
#ifndef SPLINE_CHAIN_LANES_H
#define SPLINE_CHAIN_LANES_H

#include "spline/chain.h"

enum { MOST_LANES = 8, LANE_ALIGNMENT = 64, DOUBLES_PER_LANE_ROW = MOST_LANES * 18 };

/// Chains that share tables; those of fewer nodes than the longest are idle at its end.
typedef struct chain_group {
    const chain *common; ///< filter, start, stretches
    int count;           ///< chains, at most as many as there are lanes
    chain_node *nodes[MOST_LANES];
    int node_count[MOST_LANES];
    chain_rank rank[MOST_LANES]; ///< CHAIN_FIRM, else chain_solve() must have a look; result
    double *rows; ///< scratch, DOUBLES_PER_LANE_ROW for each node of the longest, aligned to LANE_ALIGNMENT
} chain_group;

/// Solves for the states at the nodes, which must have been given their stretches and been reset.
typedef void chain_group_solver(chain_group *group);
chain_group_solver chain_solve_by_4, chain_solve_by_8;

/// Lanes that this processor's vectors have: 8, 4, or 0 where chain_solve() is the better one.
int chain_lanes(void);

#endif
