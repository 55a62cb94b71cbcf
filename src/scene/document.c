#include "scene/document.h"
#include "base/path.h"
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *coordinate_name(int index)
{
    static const char *const names[] = {"x", "y", "z"};
    return names[index];
}

void spline_reset(struct spline *spline)
{
    spline->spring_friction = false;
    spline->color = -1;
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        spline->parameter[i] = (struct param){parameter_rows[i].standard, -1};
    }
}

struct document *document_create(void)
{
    struct document *document = calloc(1, sizeof *document);
    if (!document) return NULL;
    document->fps = 24;
    document->substeps = 1;
    document->last_frame = 120;
    document->next_id = document->next_spline_id = 1;
    return document;
}

void document_destroy(struct document *document)
{
    if (!document) return;
    for (int i = 0; i < document->spline_count; i++) {
        free(document->splines[i].name);
        free(document->splines[i].knots);
    }
    for (int i = 0; i < document->tail_count; i++) {
        free(document->tails[i].name);
        free(document->tails[i].channels);
    }
    for (int i = 0; i < document->character_count; i++) {
        free(document->characters[i].name);
        free(document->characters[i].model);
        free(document->characters[i].paint);
        paint_destroy(document->characters[i].painted);
    }
    free(document->path);
    free(document->about);
    free(document->splines);
    free(document->tails);
    free(document->characters);
    free(document->folder);
    json_decref(document->owned);
    free(document);
}

/// Replaces a path by the one from the new folder.
static bool move_path(char **path, const char *from, const char *to)
{
    char moved[PATH_LIMIT];
    if (!*path || !path_rebase(*path, from, to, moved)) return true;
    char *copy = strdup(moved);
    if (!copy) return false;
    free(*path);
    *path = copy;
    return true;
}

bool document_set_folder(struct document *document, const char *folder)
{
    char *copy = folder ? strdup(folder) : NULL;
    if (folder && !copy) return false;
    bool moved = true;
    for (int i = 0; i < document->character_count; i++) {
        moved &= move_path(&document->characters[i].model, document->folder, folder);
        moved &= move_path(&document->characters[i].paint, document->folder, folder);
    }
    free(document->folder);
    document->folder = copy;
    return moved;
}

const char *document_keep_text(struct document *document, const char *text)
{
    json_t *string = json_string(text);
    if (!document->owned) document->owned = json_array();
    return json_array_append_new(document->owned, string) == 0 ? json_string_value(string) : NULL;
}

bool document_set_path(struct document *document, const char *path)
{
    char *copy = path && path[0] ? strdup(path) : NULL;
    if (path && path[0] && !copy) return false;
    free(document->path);
    document->path = copy;
    return true;
}

size_t document_bytes(const struct document *document)
{
    size_t bytes = sizeof *document;
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = &document->splines[i];
        bytes += sizeof *spline + (size_t)spline->knot_capacity * sizeof *spline->knots + strlen(spline->name) + 1;
    }
    for (int i = 0; i < document->tail_count; i++) {
        const struct tail *tail = &document->tails[i];
        bytes += sizeof *tail + (size_t)tail->channel_count * sizeof *tail->channels + strlen(tail->name) + 1;
    }
    for (int i = 0; i < document->character_count; i++) {
        const struct character_rig *rig = &document->characters[i];
        bytes += sizeof *rig + strlen(rig->model) + 1 + paint_bytes(rig->painted);
    }
    return bytes;
}

int document_samples(const struct document *document)
{
    return (document->last_frame - document->first_frame) * document->substeps + 1;
}

double document_step(const struct document *document) { return 1 / (document->fps * document->substeps); }

int document_sample(const struct document *document, double frame)
{
    double sample = floor((frame - document->first_frame) * document->substeps + 0.5);
    if (sample > INT_MAX / 2) return INT_MAX / 2;
    if (sample < -(INT_MAX / 2)) return -(INT_MAX / 2);
    return (int)sample;
}

double document_frame(const struct document *document, int sample)
{
    return document->first_frame + (double)sample / document->substeps;
}

int document_last_knot_sample(const struct document *document, const struct spline *spline)
{
    return document_samples(document) - (spline_start(spline) == WIGGLY_LOOP ? 2 : 1);
}

int document_find_spline(const struct document *document, const char *name)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (strcmp(document->splines[i].name, name) == 0) return i;
    }
    return -1;
}

int document_find_spline_id(const struct document *document, unsigned id)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (document->splines[i].id == id) return i;
    }
    return -1;
}

int spline_find_knot(const struct document *document, const struct spline *spline, int sample)
{
    int at = spline_lower_bound(document, spline, sample);
    if (at == spline->knot_count || document_sample(document, spline->knots[at].frame) != sample) return -1;
    return at;
}

int spline_lower_bound(const struct document *document, const struct spline *spline, int sample)
{
    int low = 0, high = spline->knot_count;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (document_sample(document, spline->knots[middle].frame) < sample) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

int spline_find_id(const struct spline *spline, unsigned id)
{
    for (int i = 0; i < spline->knot_count; i++) {
        if (spline->knots[i].id == id) return i;
    }
    return -1;
}
