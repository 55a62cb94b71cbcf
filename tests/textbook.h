/// The spline as a textbook would solve it: every row of the energy written out from docs/mathematics.md, squared into a dense
/// matrix in extended precision, plain Cholesky. Slow, and as independent of src/spline as can be.
#ifndef TESTS_TEXTBOOK_H
#define TESTS_TEXTBOOK_H

#include <stdbool.h>
#include <wiggly/wiggly.h>

enum { TEXTBOOK_MAX = 64 }; ///< samples

/// A dense system: `unknowns` free ones of the 2·samples numbers (Re x_k at 2k, Im x_k at 2k + 1).
struct textbook {
    int first, count; ///< the domain: samples first … first + count − 1
    long double matrix[2 * TEXTBOOK_MAX][2 * TEXTBOOK_MAX], right[2 * TEXTBOOK_MAX], x[2 * TEXTBOOK_MAX];
    bool fixed[2 * TEXTBOOK_MAX];
    bool used[2 * TEXTBOOK_MAX];
};

/// Normal equations of a description with at least 3 samples in its domain and not still; fixed unknowns are in x.
void textbook_assemble(const wiggly_desc *desc, struct textbook *book);

/// Solves by dense Cholesky into x. false where a pivot is not above 1e-13 of its diagonal entry.
bool textbook_solve(struct textbook *book);

#endif
