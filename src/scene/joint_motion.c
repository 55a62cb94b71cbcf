/// Keeps the motions that a document names, each once.
#include "scene/joint_motion.h"
#include "base/path.h"
#include "scene/text.h"
#include <stdlib.h>
#include <string.h>

const char *const motion_words[] = {
    [MOTION_TURN] = "turn", [MOTION_ACROSS] = "across", [MOTION_UP] = "up", [MOTION_KINDS] = NULL};

static bool same_text(const char *a, const char *b) { return a == b || (a && b && strcmp(a, b) == 0); }

static bool same_motion(const struct joint_motion *a, const struct joint_motion *b)
{
    return a->of == b->of && a->by_file == b->by_file && same_text(a->model, b->model) &&
           same_text(a->joint, b->joint) && same_text(a->chain, b->chain);
}

static void destroy(struct joint_motion *motion)
{
    free(motion->model);
    free(motion->joint);
    free(motion->chain);
    free(motion);
}

void motion_list_free(struct motion_list *list)
{
    for (int i = 0; i < list->count; i++) destroy(list->items[i]);
    free(list->items);
}

bool motion_list_rebase(struct motion_list *list, const char *from, const char *to)
{
    bool moved = true;
    for (int i = 0; i < list->count; i++) {
        if (list->items[i]->by_file) moved &= path_move(&list->items[i]->model, from, to);
    }
    return moved;
}

size_t motion_list_bytes(const struct motion_list *list)
{
    size_t bytes = 0;
    for (int i = 0; i < list->count; i++) {
        const struct joint_motion *motion = list->items[i];
        bytes += sizeof *motion + text_size(motion->model) + text_size(motion->joint) + text_size(motion->chain);
    }
    return bytes;
}

static struct joint_motion *copy_of(const struct joint_motion *motion)
{
    struct joint_motion *copy = malloc(sizeof *copy);
    if (!copy) return NULL;
    *copy = *motion;
    copy->model = strdup(motion->model);
    copy->joint = strdup(motion->joint);
    copy->chain = motion->chain ? strdup(motion->chain) : NULL;
    if (copy->model && copy->joint && (copy->chain || !motion->chain)) return copy;
    destroy(copy);
    return NULL;
}

const struct joint_motion *motion_list_keep(struct motion_list *list, const struct joint_motion *motion)
{
    for (int i = 0; i < list->count; i++) {
        if (same_motion(list->items[i], motion)) return list->items[i];
    }
    struct joint_motion **items = realloc(list->items, ((size_t)list->count + 1) * sizeof *items);
    if (!items) return NULL;
    list->items = items;
    struct joint_motion *copy = copy_of(motion);
    if (copy) items[list->count++] = copy;
    return copy;
}
