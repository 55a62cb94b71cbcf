#include "rig/cast.h"
#include "base/path.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// A file that was read, and what it was like then.
struct reel {
    char *path; ///< absolute
    struct timespec changed;
    off_t size;
    struct figure figure;
};

struct cast {
    struct reel **reels;
    int reel_count;
    const struct figure **figures; ///< by character, pointing into the reels
    int figure_count;
};

struct cast *cast_create(void) { return calloc(1, sizeof(struct cast)); }

static void reel_destroy(struct reel *reel)
{
    if (!reel) return;
    figure_free(&reel->figure);
    free(reel->path);
    free(reel);
}

void cast_destroy(struct cast *cast)
{
    if (!cast) return;
    for (int i = 0; i < cast->reel_count; i++) reel_destroy(cast->reels[i]);
    free(cast->reels);
    free(cast->figures);
    free(cast);
}

static bool is_current(const struct reel *reel, const struct stat *about)
{
    return reel->size == about->st_size && reel->changed.tv_sec == about->st_mtim.tv_sec &&
           reel->changed.tv_nsec == about->st_mtim.tv_nsec;
}

static int find_reel(const struct cast *cast, const char *path)
{
    for (int i = 0; i < cast->reel_count; i++) {
        if (strcmp(cast->reels[i]->path, path) == 0) return i;
    }
    return -1;
}

static struct reel *read_reel(const char *path, struct error *error)
{
    struct character character = {0};
    struct reel *reel = calloc(1, sizeof *reel);
    if (!reel || !(reel->path = strdup(path))) {
        reel_destroy(reel);
        fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", path);
        return NULL;
    }
    if (!character_read(path, &character, error)) {
        reel_destroy(reel);
        return NULL;
    }
    if (!figure_create(&reel->figure, &character)) {
        reel_destroy(reel);
        fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", path);
        return NULL;
    }
    return reel;
}

/// The figure in a file: the one read before, or read now in its place; NULL with a sentence.
static const struct figure *obtain(struct cast *cast, const char *path, struct error *error)
{
    struct stat about = {0};
    bool is_there = stat(path, &about) == 0;
    int at = find_reel(cast, path);
    if (at >= 0 && is_there && is_current(cast->reels[at], &about)) return &cast->reels[at]->figure;
    struct reel *reel = read_reel(path, error);
    if (!reel) return NULL;
    reel->changed = about.st_mtim;
    reel->size = about.st_size;
    if (at >= 0) {
        reel_destroy(cast->reels[at]);
    } else {
        struct reel **reels = realloc(cast->reels, ((size_t)cast->reel_count + 1) * sizeof(struct reel *));
        if (!reels) {
            reel_destroy(reel);
            fail(error, ERROR_ENVIRONMENT, "%s: not enough memory", path);
            return NULL;
        }
        cast->reels = reels;
        at = cast->reel_count++;
    }
    cast->reels[at] = reel;
    return &reel->figure;
}

/// Coordinates that the scene asks for and the model does not have.
static bool check_names(const struct character_rig *rig, const struct figure *figure, struct error *error)
{
    for (int k = 0; k < rig->drive_count; k++) {
        if (figure_find(figure, rig->drives[k].name) >= 0) continue;
        const struct character *c = &figure->character;
        return fail(error, ERROR_INPUT, "%s: expected a coordinate called \"%s\", got %s%s", rig->model,
                    rig->drives[k].name, c->coordinate_count > 0 ? "others, such as " : "none",
                    c->coordinate_count > 0 ? c->coordinates[0].name : "");
    }
    return true;
}

bool cast_update(struct cast *cast, const struct document *document, struct error *error)
{
    struct error first = {0};
    size_t room = (size_t)document->character_count + 1;
    const struct figure **figures = realloc(cast->figures, room * sizeof(const struct figure *));
    cast->figure_count = 0;
    if (!figures) return fail(error, ERROR_ENVIRONMENT, "not enough memory for the characters");
    cast->figures = figures;
    for (int i = 0; i < document->character_count; i++) {
        const struct character_rig *rig = &document->characters[i];
        struct error trouble = {0};
        char path[PATH_LIMIT];
        figures[i] = NULL;
        if (path_resolve(document->folder, rig->model, path)) {
            figures[i] = obtain(cast, path, &trouble);
            if (figures[i]) check_names(rig, figures[i], &trouble);
        } else {
            fail(&trouble, ERROR_INPUT, "%s: the path is too long", rig->model);
        }
        if (first.kind == ERROR_NONE) first = trouble;
    }
    cast->figure_count = document->character_count;
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

const struct figure *cast_figure(const struct cast *cast, int character)
{
    return cast && character < cast->figure_count ? cast->figures[character] : NULL;
}
