/// LAPACKE and OpenBLAS, loaded at run time: the analysis, tests and benchmark need them, the live app does not.
#ifndef BASE_LAPACK_H
#define BASE_LAPACK_H

#include <complex.h>
#include <stdbool.h>
#include <stddef.h>

/// The functions that are used, as LAPACKE and CBLAS declare them.
struct lapack {
    void *lapacke, *blas;
    int (*dpbsv)(int layout, char uplo, int n, int kd, int columns, double *ab, int ldab, double *b, int ldb);
    int (*dsyevd)(int layout, char vectors, char uplo, int n, double *a, int lda, double *values);
    int (*zheevd)(int layout, char vectors, char uplo, int n, double complex *a, int lda, double *values);
    int (*dgeev)(int layout, char left, char right, int n, double *a, int lda, double *re, double *im, double *vl,
                 int ldvl, double *vr, int ldvr);
    void (*dsyrk)(int order, int uplo, int transpose, int n, int k, double alpha, const double *a, int lda,
                  double beta, double *c, int ldc);
    void (*dgemm)(int order, int transpose_a, int transpose_b, int m, int n, int k, double alpha, const double *a,
                  int lda, const double *b, int ldb, double beta, double *c, int ldc);
};

/// LAPACKE's and CBLAS's numbers.
enum {
    LAPACK_ROWS_FIRST = 101,
    LAPACK_COLUMNS_FIRST = 102,
    BLAS_PLAIN = 111,
    BLAS_TRANSPOSED = 112,
    BLAS_LOWER = 122
};

/// Loads liblapacke and OpenBLAS with one thread; `description` says what was found. False, with all functions NULL,
/// if the libraries or one of their functions are missing.
bool lapack_load(struct lapack *lapack, char *description, size_t size);
void lapack_unload(struct lapack *lapack);

#endif
