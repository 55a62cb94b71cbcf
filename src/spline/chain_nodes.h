/// What the nodes' systems of a chain and of a loop share: rows of plain numbers, and the rank of a factor.
#ifndef SPLINE_CHAIN_NODES_H
#define SPLINE_CHAIN_NODES_H

typedef double lane;
typedef int flag;
#include "spline/chain_kernel.h"

static inline chain_rank chain_rank_of(kernel_rank rank)
{
    return !rank.sound ? CHAIN_LOST : rank.firm ? CHAIN_FIRM : CHAIN_WEAK;
}

static inline void chain_add_rank(kernel_rank *all, kernel_rank rank)
{
    kernel_add_rank(all, rank);
    all->lost = rank.lost > all->lost ? rank.lost : all->lost;
}

/// The rank of a factor, and what it has lost.
static inline chain_rank chain_rank_with_loss(chain *c, kernel_rank rank)
{
    c->lost = rank.lost;
    rank.firm &= rank.lost < GREATEST_LOSS;
    return chain_rank_of(rank);
}

/// Factors a loop's rows.
chain_rank chain_close(chain *chain);

/// rows' right ← solution of a loop's.
void chain_solve_loop(chain *chain);

#endif
