/// Makes the nodes of a spline that is pulled at some of its samples. Internal to the chain that is pulled at (pull_chain.c).
#ifndef SPLINE_PULL_NODES_H
#define SPLINE_PULL_NODES_H

#include "spline/pull.h"

/// The chain's nodes and their states. false where a slope is on the second sample of a node, where the chain has no place for it, or
/// every sample of a loop has a knot or a pull.
bool pull_make_nodes(pulled *of);

/// The n-th pull as the chain has them: a loop's need not begin with the first.
static inline int pull_in_turn(const pulled *of, int n) { return (of->first_pull + n) % of->pulls.count; }

#endif
