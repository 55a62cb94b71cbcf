/// Matches typed text with list rows.
#include "ui/filter.h"
#include "base/error.h"
#include <ctype.h>
#include <string.h>
#include <strings.h>

static bool is_inside_word(const char *text, const char *at)
{
    return at > text && (isalnum((unsigned char)at[-1]) || (unsigned char)at[-1] >= 0x80);
}

static bool has_letters(const char *text, const char *word, size_t length)
{
    size_t found = 0;
    for (; *text && found < length; text++)
        found += tolower((unsigned char)*text) == tolower((unsigned char)word[found]);
    return found == length;
}

static enum fit fit_word(const char *text, const char *word, size_t length)
{
    enum fit best = has_letters(text, word, length) ? FIT_LETTERS : FIT_NOT;
    if (best == FIT_NOT) return FIT_NOT;
    for (const char *at = text; *at; at++) {
        if (strncasecmp(at, word, length) != 0) continue;
        const enum fit fit = at == text ? FIT_START : is_inside_word(text, at) ? FIT_INSIDE : FIT_WORD;
        if (fit > best) best = fit;
    }
    return best;
}

enum fit ui_filter_fit(const struct ui_filter *filter, const char *text)
{
    enum fit worst = FIT_START;
    const char *word = filter->typed;
    while (*(word += strspn(word, " "))) {
        const size_t length = strcspn(word, " ");
        const enum fit fit = fit_word(text, word, length);
        if (fit < worst) worst = fit;
        word += length;
    }
    return worst;
}

enum fit ui_filter_least(enum fit best) { return best >= FIT_INSIDE ? FIT_INSIDE : FIT_LETTERS; }

bool ui_filter_event(struct ui_filter *filter, const struct event *event)
{
    size_t length = strlen(filter->typed);
    if (event->kind == EVENT_KEY && event->key == KEY_BACKSPACE && event->action != ACTION_RELEASE && length > 0) {
        while (length > 1 && ((unsigned char)filter->typed[length - 1] & 0xC0) == 0x80) length--;
        filter->typed[length - 1] = '\0';
        return true;
    }
    if (event->kind != EVENT_TEXT || event->codepoint < ' ' || event->codepoint == 0x7F) return false;
    char bytes[4];
    const int count = utf8_encode(event->codepoint, bytes);
    if ((length == 0 && bytes[0] == ' ') || length + (size_t)count >= sizeof filter->typed) return false;
    memcpy(filter->typed + length, bytes, (size_t)count);
    filter->typed[length + (size_t)count] = '\0';
    return true;
}
