/// LAPACKE, loaded at run time: only the benchmark needs it.
#ifndef TIMING_LAPACK_H
#define TIMING_LAPACK_H

#include <complex.h>
#include <stddef.h>

struct lapack {
    void *lapacke, *blas;
    int (*dpbsv)(int layout, char uplo, int n, int kd, int columns, double *ab, int ldab, double *b, int ldb);
    int (*zpbsv)(int layout, char uplo, int n, int kd, int columns, double complex *ab, int ldab, double complex *b,
                 int ldb);
};

enum { LAPACK_COLUMNS_FIRST = 102 };

/// Loads liblapacke and OpenBLAS with one thread; `description` says what was found. NULL functions where nothing was.
void lapack_load(struct lapack *lapack, char *description, size_t size);
void lapack_unload(struct lapack *lapack);

#endif
