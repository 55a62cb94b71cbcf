/// Reads the models of a document's characters, and keeps them by path.
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

/// What a character is played by.
struct role {
    const struct figure *plain; ///< in the reels; NULL where it could not be read
    struct painted *painted;    ///< NULL as long as nobody has painted on it
    uint64_t version;           ///< of the paint that it has, 0: none
};

struct cast {
    struct reel **reels;
    int reel_count;
    struct role *roles; ///< one a character
    int role_count;
};

struct cast *cast_create(void) { return calloc(1, sizeof(struct cast)); }

static void reel_destroy(struct reel *reel)
{
    if (!reel) return;
    figure_free(&reel->figure);
    free(reel->path);
    free(reel);
}

static void drop_roles(struct cast *cast)
{
    for (int i = 0; i < cast->role_count; i++) painted_destroy(cast->roles[i].painted);
    cast->role_count = 0;
}

void cast_destroy(struct cast *cast)
{
    if (!cast) return;
    drop_roles(cast);
    for (int i = 0; i < cast->reel_count; i++) reel_destroy(cast->reels[i]);
    free(cast->reels);
    free(cast->roles);
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
        fail_no_memory(error, path);
        return NULL;
    }
    if (!character_read(path, &character, error)) {
        reel_destroy(reel);
        return NULL;
    }
    if (!figure_create(&reel->figure, &character)) {
        reel_destroy(reel);
        fail_no_memory(error, path);
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
            fail_no_memory(error, path);
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

bool cast_fits(const struct paint *paint, const struct figure *figure)
{
    return paint->coordinates == figure->character.coordinate_count &&
           paint->vertices == figure->character.vertex_count;
}

static bool check_paint(const struct character_rig *rig, const struct figure *figure, struct error *error)
{
    const struct paint *paint = rig->painted;
    if (!paint || cast_fits(paint, figure)) return true;
    return fail(error, ERROR_INPUT, "%s: expected paint for the %d coordinates of %d vertices of %s, got %d of %d",
                rig->paint ? rig->paint : "paint", figure->character.coordinate_count, figure->character.vertex_count,
                rig->model, paint->coordinates, paint->vertices);
}

/// The model of one rig, or NULL with a sentence; also with one where it does not suit the rig.
static const struct figure *find_figure(struct cast *cast, const struct document *document,
                                        const struct character_rig *rig, struct error *error)
{
    char path[PATH_LIMIT];
    if (!path_resolve(document->folder, rig->model, path)) {
        fail(error, ERROR_INPUT, "%s: the path is too long", rig->model);
        return NULL;
    }
    const struct figure *figure = obtain(cast, path, error);
    if (figure && check_names(rig, figure, error)) check_paint(rig, figure, error);
    return figure;
}

bool cast_update(struct cast *cast, const struct document *document, struct error *error)
{
    struct error first = {0};
    drop_roles(cast);
    const int count = document_count_rigs(document, RIG_CHARACTER);
    struct role *roles = realloc(cast->roles, ((size_t)count + 1) * sizeof *roles);
    if (!roles) return fail(error, ERROR_ENVIRONMENT, "not enough memory for the characters");
    cast->roles = roles;
    int rig = document_next_rig(document, RIG_CHARACTER, 0);
    for (int i = 0; i < count; i++, rig = document_next_rig(document, RIG_CHARACTER, rig + 1)) {
        struct error trouble = {0};
        roles[i] = (struct role){.plain = find_figure(cast, document, &document->rigs[rig].character, &trouble)};
        if (first.kind == ERROR_NONE) first = trouble;
    }
    cast->role_count = count;
    cast_paint(cast, document);
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

void cast_paint(struct cast *cast, const struct document *document)
{
    int rig = document_next_rig(document, RIG_CHARACTER, 0);
    for (int i = 0; i < cast->role_count && rig >= 0;
         i++, rig = document_next_rig(document, RIG_CHARACTER, rig + 1)) {
        const struct paint *paint = document->rigs[rig].character.painted;
        struct role *role = &cast->roles[i];
        if (paint && (!role->plain || !cast_fits(paint, role->plain))) paint = NULL;
        if (role->version == (paint ? paint->version : 0)) continue;
        if (!role->painted) role->painted = painted_create(role->plain);
        if (!role->painted) continue;
        painted_update(role->painted, paint ? (const float(*)[2])paint->values : NULL);
        role->version = paint ? paint->version : 0;
    }
}

const struct figure *cast_figure(const struct cast *cast, int character)
{
    if (!cast || character >= cast->role_count) return NULL;
    const struct role *role = &cast->roles[character];
    return role->painted ? &role->painted->figure : role->plain;
}
