/// A tree over the chain's nodes, by nested elimination.
//
// Nested elimination of the nodes' system. A run of rows 0 … m−1 has its inner rows eliminated from left to right; beside the row
// after it, each also couples to the run's first row:
//
//     F_1 = A_10,    S_0 −= F_kᵀ P_k F_k,    S_{k+1} −= A_{k+1,k} P_k A_{k+1,k}ᵀ,    F_{k+1} = −A_{k+1,k} P_k F_k,    P_k = S_k⁻¹
//
// What is left are the run's two ends and F_{m−1} between them: an element. Sixteen neighbouring elements are again a run, of
// twice as many rows, up to one element at the root. Which rows form an element depends on their number alone, so a tree that
// was edited is the same as a fresh one.
#include "spline/tree.h"
#include <math.h>
#include <string.h>

/// Longest run: the last element of a level takes what is left over.
enum { MAX_RUN = 2 * (2 * TREE_FAN - 1) };

/// m ← X y for a 3×3 X; transposed where asked.
static void apply(const double *x, const double *y, double *out)
{
    for (int r = 0; r < 3; r++) out[r] = x[3 * r] * y[0] + x[3 * r + 1] * y[1] + x[3 * r + 2] * y[2];
}

static void apply_transposed(const double *x, const double *y, double *out)
{
    for (int r = 0; r < 3; r++) out[r] = x[r] * y[0] + x[3 + r] * y[1] + x[6 + r] * y[2];
}

static void apply_symmetric(const double *s, const double *y, double *out)
{
    out[0] = s[0] * y[0] + s[1] * y[1] + s[2] * y[2];
    out[1] = s[1] * y[0] + s[3] * y[1] + s[4] * y[2];
    out[2] = s[2] * y[0] + s[4] * y[1] + s[5] * y[2];
}

/// out ← P X for symmetric P, 3×3 X.
static void symmetric_times(const double *p, const double *x, double *out)
{
    for (int c = 0; c < 3; c++) {
        double column[3] = {x[c], x[3 + c], x[6 + c]}, product[3];
        apply_symmetric(p, column, product);
        for (int r = 0; r < 3; r++) out[3 * r + c] = product[r];
    }
}

/// s ← s − Xᵀ Y, of which only the upper triangle is kept (it is symmetric).
static void subtract_square(double *s, const double *x, const double *y)
{
    static const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 3; k++) s[i] -= x[3 * k + row[i]] * y[3 * k + column[i]];
    }
}

static void transpose(const double *x, double *out)
{
    for (int i = 0; i < 9; i++) out[i] = x[3 * (i % 3) + i / 3];
}

static void subtract(double *a, const double *b)
{
    for (int i = 0; i < 3; i++) a[i] -= b[i];
}

/// Eliminates the inner rows of a run into an element.
static bool condense(tree_row *run, int rows, tree_element *element)
{
    double f[9];
    memcpy(f, run[0].below, sizeof f);
    memcpy(element->first, run[0].pivot, sizeof element->first);
    memcpy(element->right_first, run[0].right, sizeof element->right_first);
    for (int k = 1; k + 1 < rows; k++) {
        tree_row *row = &run[k];
        double p[6], pf[9], pr[3], product[9], out[3], up[9];
        chain_rank rank = chain_invert(row->pivot, p);
        if (rank == CHAIN_LOST) return false;
        if (rank == CHAIN_WEAK) element->weak = true;
        memcpy(row->pivot, p, sizeof p);
        memcpy(row->to_first, f, sizeof f);
        symmetric_times(p, f, pf);
        apply_symmetric(p, row->right, pr);
        subtract_square(element->first, f, pf);
        apply_transposed(f, pr, out);
        subtract(element->right_first, out);
        transpose(row->below, up);
        symmetric_times(p, up, product);
        subtract_square(run[k + 1].pivot, up, product);
        apply(row->below, pr, out);
        subtract(run[k + 1].right, out);
        for (int c = 0; c < 3; c++) {
            double column[3] = {pf[c], pf[3 + c], pf[6 + c]};
            apply(row->below, column, out);
            for (int r = 0; r < 3; r++) f[3 * r + c] = -out[r];
        }
    }
    memcpy(element->last, run[rows - 1].pivot, sizeof element->last);
    memcpy(element->right_last, run[rows - 1].right, sizeof element->right_last);
    memcpy(element->coupling, f, sizeof f);
    return true;
}

/// The chain's row j as a 3×3 one; outside complex mode d is the middle unknown of three.
static void load_row(const chain *c, int j, tree_row *to)
{
    const chain_row *from = &c->rows[j];
    if (c->is_complex) {
        memcpy(to->pivot, from->diagonal, sizeof to->pivot);
        memcpy(to->below, from->below, sizeof to->below);
        memcpy(to->right, from->right, sizeof to->right);
        return;
    }
    *to = (tree_row){.pivot = {1, 0, 0, from->diagonal[0], 0, 1}, .right = {0, from->right[0], 0}};
    to->below[4] = from->below[0];
}

static int parents_of(int count) { return count / TREE_FAN > 1 ? count / TREE_FAN : 1; }

int tree_shape(int rows, int count[TREE_MAX_LEVELS], int run_rows[TREE_MAX_LEVELS])
{
    int levels = 0, below = rows;
    do {
        count[levels] = parents_of(below);
        run_rows[levels] = levels == 0 ? rows : 2 * below;
        below = count[levels++];
    } while (below > 1);
    return levels;
}

/// Children of an element are first … last (rows of the chain at level 0).
static int first_child(int e) { return e * TREE_FAN; }

static int last_child(const tree *t, int level, int e)
{
    int below = level == 0 ? t->chain->node_count : t->count[level - 1];
    return e + 1 == t->count[level] ? below - 1 : (e + 1) * TREE_FAN - 1;
}

static int parent_of(const tree *t, int level, int child)
{
    int e = child / TREE_FAN;
    return e < t->count[level] ? e : t->count[level] - 1;
}

/// First and last row of the chain under an element.
static int first_row(int level, int e)
{
    for (int l = level; l >= 0; l--) e = first_child(e);
    return e;
}

static int last_row(const tree *t, int level, int e)
{
    for (int l = level; l >= 0; l--) e = last_child(t, l, e);
    return e;
}

static bool condense_element(tree *t, int level, int e)
{
    int from = first_child(e), to = last_child(t, level, e);
    tree_element *element = &t->elements[level][e];
    element->weak = false;
    if (level == 0) {
        for (int j = from; j <= to; j++) load_row(t->chain, j, &t->rows[0][j]);
        return condense(&t->rows[0][from], to - from + 1, element);
    }
    tree_row *run = &t->rows[level][2 * from];
    for (int child = from; child <= to; child++) {
        const tree_element *c = &t->elements[level - 1][child];
        tree_row *head = &run[2 * (child - from)], *tail = head + 1;
        load_row(t->chain, last_row(t, level - 1, child), tail); // for its coupling to the next child
        memcpy(head->pivot, c->first, sizeof head->pivot);
        memcpy(head->below, c->coupling, sizeof head->below);
        memcpy(head->right, c->right_first, sizeof head->right);
        memcpy(tail->pivot, c->last, sizeof tail->pivot);
        memcpy(tail->right, c->right_last, sizeof tail->right);
        if (c->weak) element->weak = true;
    }
    return condense(run, 2 * (to - from + 1), element);
}

bool tree_update(tree *t, int from, int to)
{
    for (int level = 0; level < t->levels; level++) {
        from = parent_of(t, level, from);
        to = parent_of(t, level, to);
        for (int e = from; e <= to; e++) {
            if (!condense_element(t, level, e)) return false;
        }
    }
    return true;
}

bool tree_grow(tree *t)
{
    int run_rows[TREE_MAX_LEVELS];
    t->levels = tree_shape(t->chain->node_count, t->count, run_rows);
    for (int level = 0; level < t->levels; level++) { // the last element may have split in two
        int last = t->count[level] - 1;
        for (int e = last > 0 ? last - 1 : 0; e <= last; e++) {
            if (!condense_element(t, level, e)) return false;
        }
    }
    return true;
}

/// Solution of a run whose ends are known: u_k = P_k (r_k − A_{k+1,k}ᵀ u_{k+1} − F_k u_0).
static void expand(const tree_row *run, int rows, double (*u)[3])
{
    for (int k = rows - 2; k >= 1; k--) {
        double right[3], part[3];
        memcpy(right, run[k].right, sizeof right);
        apply_transposed(run[k].below, u[k + 1], part);
        subtract(right, part);
        apply(run[k].to_first, u[0], part);
        subtract(right, part);
        apply_symmetric(run[k].pivot, right, u[k]);
    }
}

/// Solves below an element whose ends are `first` and `last`, where it has rows in from … to.
static void descend(const tree *t, int level, int e, const double *first, const double *last, int from, int to)
{
    int begin = first_child(e), end = last_child(t, level, e), per_child = level == 0 ? 1 : 2;
    int rows = per_child * (end - begin + 1);
    double u[MAX_RUN][3];
    memcpy(u[0], first, sizeof u[0]);
    memcpy(u[rows - 1], last, sizeof u[0]);
    expand(&t->rows[level][per_child * begin], rows, u);
    for (int child = begin; child <= end; child++) {
        if (level == 0) {
            chain_node *node = &t->chain->nodes[child];
            if (child >= from && child <= to)
                chain_add_to_node(t->chain, node, u[child - begin] + (t->chain->is_complex ? 0 : 1));
        } else if (first_row(level - 1, child) <= to && last_row(t, level - 1, child) >= from) {
            descend(t, level - 1, child, u[2 * (child - begin)], u[2 * (child - begin) + 1], from, to);
        }
    }
}

bool tree_solve(const tree *t, int from, int to)
{
    const tree_element *root = &t->elements[t->levels - 1][0];
    double p[6], s[6], inverse[6], up[9], product[9], part[3], first[3], last[3];
    if (chain_invert(root->first, p) == CHAIN_LOST) return false;
    transpose(root->coupling, up);
    symmetric_times(p, up, product);
    memcpy(s, root->last, sizeof s);
    subtract_square(s, up, product);
    if (chain_invert(s, inverse) == CHAIN_LOST) return false;
    double right[3];
    apply_symmetric(p, root->right_first, part);
    apply(root->coupling, part, first);
    memcpy(right, root->right_last, sizeof right);
    subtract(right, first);
    apply_symmetric(inverse, right, last);
    apply(up, last, part); // Cᵀ u_last
    memcpy(right, root->right_first, sizeof right);
    subtract(right, part);
    apply_symmetric(p, right, first);
    descend(t, t->levels - 1, 0, first, last, from, to);
    return true;
}
