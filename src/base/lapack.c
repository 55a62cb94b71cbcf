/// Loads LAPACKE and OpenBLAS at run time.
#include "base/lapack.h"
#include "base/need.h"
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/// dlsym() returns an object pointer; POSIX allows copying it into a function pointer, C forbids the cast.
static void find_symbol(void *library, const char *name, void *function)
{
    void *symbol = library ? dlsym(library, name) : NULL;
    memcpy(function, &symbol, sizeof symbol);
}

bool lapack_load(struct lapack *lapack, char *description, size_t size)
{
    *lapack = (struct lapack){0};
    void (*set_threads)(int) = NULL;
    char *(*get_config)(void) = NULL;
    lapack->blas = dlopen("libopenblas.so.0", RTLD_NOW | RTLD_GLOBAL);
    lapack->lapacke = dlopen("liblapacke.so.3", RTLD_NOW);
    find_symbol(lapack->blas, "openblas_set_num_threads", &set_threads);
    find_symbol(lapack->blas, "openblas_get_config", &get_config);
    find_symbol(lapack->blas, "cblas_dsyrk", &lapack->dsyrk);
    find_symbol(lapack->blas, "cblas_dgemm", &lapack->dgemm);
    find_symbol(lapack->lapacke, "LAPACKE_dpbsv", &lapack->dpbsv);
    find_symbol(lapack->lapacke, "LAPACKE_dsyevd", &lapack->dsyevd);
    find_symbol(lapack->lapacke, "LAPACKE_zheevd", &lapack->zheevd);
    find_symbol(lapack->lapacke, "LAPACKE_dgeev", &lapack->dgeev);
    if (set_threads) set_threads(1);
    bool whole = lapack->dpbsv && lapack->dsyevd && lapack->zheevd && lapack->dgeev && lapack->dsyrk && lapack->dgemm;
    if (!whole) {
        lapack_unload(lapack);
        snprintf(description, size, "not found (install liblapacke and libopenblas0)");
    } else if (!need_has_room((size_t)160 << 20)) {
        lapack_unload(lapack);
        snprintf(description, size, "not enough memory for OpenBLAS's buffer");
        return false;
    } else {
        // At its first call OpenBLAS allocates a buffer of 128 MiB and keeps it; without memory it retries for ever. So the call is made here,
        // after checking that there is enough.
        double one = 1, sum = 0;
        lapack->dsyrk(LAPACK_ROWS_FIRST, BLAS_LOWER, BLAS_PLAIN, 1, 1, 1, &one, 1, 0, &sum, 1);
        snprintf(description, size, "%s, one thread", get_config ? get_config() : "liblapacke.so.3");
    }
    return whole;
}

void lapack_unload(struct lapack *lapack)
{
    if (lapack->lapacke) dlclose(lapack->lapacke);
    if (lapack->blas) dlclose(lapack->blas);
    *lapack = (struct lapack){0};
}
