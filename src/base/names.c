/// Makes names differ, and cuts them.
#include "base/names.h"
#include "base/error.h"
#include "base/need.h"
#include <search.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NUMBER_ROOM = 12 }; ///< bytes of what goes before a number, and the number

/// A text that is a name, or the beginning of some.
struct used {
    const char *text;
    int next; ///< the number to try next, so that many equal names take linear time
    bool is_taken;
};

static int compare_names(const void *a, const void *b)
{
    return strcmp(((const struct used *)a)->text, ((const struct used *)b)->text);
}

/// What is known of a text's first bytes; nothing at first.
static struct used *used_of(struct names *names, const char *text, int length)
{
    struct used *used = pool_take(&names->pool, 1, sizeof *used + (size_t)length + 1);
    memcpy(used + 1, text, (size_t)length);
    *used = (struct used){.text = (char *)(used + 1), .next = 2};
    struct used **found = tsearch(used, &names->tree, compare_names);
    if (found) return *found;
    need_failed();
}

const char *names_add(struct names *names, const char *wanted)
{
    const size_t most = names->most > 0 ? names->most : INT32_MAX;
    struct used *used = used_of(names, wanted, name_fit(wanted, most));
    if (used->is_taken) {
        struct used *stem = used_of(names, used->text, name_fit(used->text, most - NUMBER_ROOM));
        const size_t room = strlen(stem->text) + NUMBER_ROOM;
        char *numbered = pool_take(&names->pool, room, 1);
        if (stem->next < names->number) stem->next = names->number;
        do snprintf(numbered, room, "%s%s%d", stem->text, names->between ? names->between : " ", stem->next++);
        while (names_has(names, numbered));
        used = used_of(names, numbered, (int)strlen(numbered));
    }
    used->is_taken = true;
    return used->text;
}

bool names_has(const struct names *names, const char *name)
{
    struct used *const *found = tfind(&(struct used){.text = name}, &names->tree, compare_names);
    return found && (*found)->is_taken;
}

static void keep(void *used) { (void)used; }

void names_free(struct names *names)
{
    tdestroy(names->tree, keep);
    pool_free(&names->pool);
    names->tree = NULL;
}

bool letter_is_blank(uint32_t c)
{
    return c <= ' ' || (c >= 0x7F && c <= 0xA0) || c == 0x1680 || (c >= 0x2000 && c <= 0x200B) || c == 0x2028 ||
           c == 0x2029 || c == 0x202F || c == 0x205F || c == 0x3000;
}

bool name_is_blank(const char *name)
{
    bool is_blank = true;
    while (*name && is_blank) is_blank = letter_is_blank(utf8_next(&name));
    return is_blank;
}

int name_fit(const char *text, size_t most)
{
    size_t length = strnlen(text, most), end = length;
    while (text[length] && end > 0 && length - end < 3 && ((unsigned char)text[end] & 0xC0) == 0x80) end--;
    return (int)(((unsigned char)text[end] & 0xC0) == 0x80 ? length : end);
}

char *name_from(const char *text, size_t length)
{
    char *const copy = need(length + 1, 1), *const name = need(3 * length + 1, 1);
    char *end = name;
    memcpy(copy, text, length);
    copy[length] = '\0';
    for (const char *at = copy; *at;) end += utf8_encode(utf8_next(&at), end);
    *end = '\0';
    free(copy);
    return name;
}
