#include "scene/tail_list.h"
#include <stdlib.h>
#include <string.h>

static void free_tail(struct tail *tail)
{
    free(tail->name);
    free(tail->channels);
    *tail = (struct tail){0};
}

bool tail_copy(const struct tail *tail, struct tail *copy)
{
    size_t count = (size_t)tail->channel_count;
    *copy = *tail;
    copy->name = strdup(tail->name);
    copy->channels = malloc((count > 0 ? count : 1) * sizeof *copy->channels);
    if (copy->name && copy->channels) {
        if (count > 0) memcpy(copy->channels, tail->channels, count * sizeof *copy->channels);
        return true;
    }
    free_tail(copy);
    return false;
}

struct tail_list *tail_list_copy(const struct document *document, int more)
{
    size_t room = (size_t)(document->tail_count + more), characters = (size_t)document->character_count;
    struct tail_list *list = calloc(1, sizeof *list);
    if (!list) return NULL;
    list->tails = calloc(room > 0 ? room : 1, sizeof *list->tails);
    list->tails_before = calloc(characters > 0 ? characters : 1, sizeof *list->tails_before);
    list->character_count = document->character_count;
    bool whole = list->tails && list->tails_before;
    for (int t = 0; whole && t < document->tail_count; t++) {
        whole = tail_copy(&document->tails[t], &list->tails[t]);
        list->count += whole;
    }
    for (int c = 0; whole && c < document->character_count; c++) {
        list->tails_before[c] = document->characters[c].tails_before;
    }
    if (whole) return list;
    tail_list_free(list);
    return NULL;
}

void tail_list_free(struct tail_list *list)
{
    if (!list) return;
    for (int t = 0; t < list->count; t++) free_tail(&list->tails[t]);
    free(list->tails);
    free(list->tails_before);
    free(list);
}

void tail_list_remove(struct tail_list *list, int index)
{
    struct tail *tail = &list->tails[index];
    free_tail(tail);
    list->count--;
    memmove(tail, tail + 1, (size_t)(list->count - index) * sizeof *tail);
    for (int c = 0; c < list->character_count; c++) list->tails_before[c] -= list->tails_before[c] > index;
}

void tail_list_swap(struct tail_list *list, struct document *document)
{
    struct tail *tails = document->tails;
    int count = document->tail_count;
    document->tails = list->tails;
    document->tail_count = list->count;
    list->tails = tails;
    list->count = count;
    for (int c = 0; c < list->character_count; c++) {
        int before = document->characters[c].tails_before;
        document->characters[c].tails_before = list->tails_before[c];
        list->tails_before[c] = before;
    }
}

size_t tail_list_bytes(const struct tail_list *list)
{
    size_t bytes = sizeof *list + (size_t)list->character_count * sizeof *list->tails_before;
    for (int t = 0; t < list->count; t++) {
        const struct tail *tail = &list->tails[t];
        bytes += sizeof *tail + (size_t)tail->channel_count * sizeof *tail->channels + strlen(tail->name) + 1;
    }
    return bytes;
}
