/// Parses options from a table, prints help, and suggests the nearest word.
#include "base/file.h"
#include "commands/commands.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_MAX = 63 };

static int smaller(int a, int b) { return a < b ? a : b; }

const char *options_nearest(const char *word, const char *const *candidates, int count)
{
    const char *nearest = NULL;
    const int word_length = (int)strnlen(word, WORD_MAX);
    int best = word_length / 3 + 1; // a larger distance means another word
    for (int c = 0; c < count; c++) {
        // Optimal string alignment distance (insertions, deletions, replacements, swaps of neighbours), with three rows of its table.
        // Words are cut at WORD_MAX.
        const char *other = candidates[c];
        const int length = (int)strnlen(other, WORD_MAX);
        int rows[3][WORD_MAX + 1];
        for (int j = 0; j <= length; j++) rows[0][j] = j;
        for (int i = 1; i <= word_length; i++) {
            int *row = rows[i % 3];
            const int *before = rows[(i + 2) % 3], *two_ago = rows[(i + 1) % 3];
            row[0] = i;
            for (int j = 1; j <= length; j++) {
                row[j] = before[j - 1] + (word[i - 1] != other[j - 1]);
                row[j] = smaller(row[j], 1 + smaller(before[j], row[j - 1]));
                bool swapped = i > 1 && j > 1 && word[i - 1] == other[j - 2] && word[i - 2] == other[j - 1];
                if (swapped) row[j] = smaller(row[j], two_ago[j - 2] + 1);
            }
        }
        const int distance = rows[word_length % 3][length];
        if (distance >= best) continue;
        best = distance;
        nearest = other;
    }
    return nearest;
}

/// Copies the long name of "-o, --output FILE", and returns the rest, "FILE".
static const char *split_words(const struct option_spec *option, char name[WORD_MAX + 1])
{
    const char *start = strstr(option->words, "--");
    const size_t length = strcspn(start, " ");
    snprintf(name, WORD_MAX + 1, "%.*s", (int)length, start);
    return start + length + (start[length] == ' ');
}

/// Parses an integer in [minimum, maximum] that ends at `end`.
static bool read_int(const char *text, char end, double minimum, double maximum, int *value, const char **rest)
{
    char *stop;
    errno = 0;
    long number = strtol(text, &stop, 10);
    if (stop == text || *stop != end || errno || (double)number < minimum || (double)number > maximum) return false;
    *value = (int)number;
    *rest = stop;
    return true;
}

static int store_value(const struct usage *usage, const struct option_spec *option, const char *text)
{
    char name[WORD_MAX + 1], expected[2 * WORD_MAX] = "", *stop;
    const char *argument = split_words(option, name), *rest;
    const double low = option->minimum, high = option->maximum;
    switch (option->kind) {
    case OPTION_FLAG:
        *(bool *)option->target = true;
        return OPTIONS_RUN;
    case OPTION_TEXT:
    case OPTION_INPUT:
    case OPTION_OUTPUT:
    case OPTION_LIST: {
        struct option_list *list = option->kind == OPTION_LIST ? option->target : NULL;
        if (!*text) return options_wrong(usage, "%s: expected %s, got nothing", name, argument);
        if (list && list->count == OPTION_LIST_MOST)
            return options_wrong(usage, "%s: expected at most %d times, got more", name, OPTION_LIST_MOST);
        *(list ? &list->text[list->count++] : (const char **)option->target) = text;
        return OPTIONS_RUN;
    }
    case OPTION_INT:
        if (read_int(text, 0, low, high, option->target, &rest)) return OPTIONS_RUN;
        snprintf(expected, sizeof expected, "a whole number from %.10g to %.10g", low, high);
        break;
    case OPTION_REAL: {
        const double number = strtod(text, &stop);
        if (stop != text && !*stop && isfinite(number) && number >= low && number <= high) {
            *(double *)option->target = number;
            return OPTIONS_RUN;
        }
        snprintf(expected, sizeof expected, "a number from %.10g to %.10g", low, high);
        break;
    }
    case OPTION_SIZE: {
        int size[2];
        if (read_int(text, 'x', low, high, &size[0], &rest) && read_int(rest + 1, 0, low, high, &size[1], &rest)) {
            memcpy(option->target, size, sizeof size);
            return OPTIONS_RUN;
        }
        snprintf(expected, sizeof expected, "WIDTHxHEIGHT, each from %.10g to %.10g", low, high);
        break;
    }
    case OPTION_WORD: {
        int number = 0;
        for (const char *word = argument; *word;) {
            const size_t span = strcspn(word, "|");
            number++;
            if (span == strlen(text) && strncmp(word, text, span) == 0) {
                *(int *)option->target = number;
                return OPTIONS_RUN;
            }
            const char *next = word + span + (word[span] == '|');
            const char *joint = !*next ? "" : strchr(next, '|') ? ", " : " or ";
            print_more(expected, sizeof expected, "%.*s%s", (int)span, word, joint);
            word = next;
        }
    }
    }
    return options_wrong(usage, "%s: expected %s, got '%s'", name, expected, text);
}

/// Parses the option at argv[*at] and its value. *at ends on the last word used.
static int read_option(const struct usage *usage, int argc, char **argv, int *at)
{
    const char *word = argv[*at];
    const char *equals = word[1] == '-' ? strchr(word, '=') : NULL;
    char names[OPTIONS_MOST][WORD_MAX + 1], given[WORD_MAX + 1];
    const char *candidates[OPTIONS_MOST + 1];
    int count = 0;
    snprintf(given, sizeof given, "%.*s", (int)(equals ? (size_t)(equals - word) : strlen(word)), word);
    for (const struct option_spec *option = usage->options; option->words; option++) {
        const char *argument = split_words(option, names[count]);
        const bool is_short = option->words[1] != '-' && strlen(word) == 2 && strncmp(word, option->words, 2) == 0;
        if (is_short || strcmp(given, names[count]) == 0) {
            if (option->kind == OPTION_FLAG && equals) return options_wrong(usage, "%s takes no value", names[count]);
            if (option->kind == OPTION_FLAG || equals) return store_value(usage, option, equals ? equals + 1 : NULL);
            if (*at + 1 < argc) return store_value(usage, option, argv[++*at]);
            return options_wrong(usage, "%s needs a value: %s", names[count], argument);
        }
        candidates[count] = names[count];
        count++;
    }
    candidates[count++] = "--help";
    const char *nearest = options_nearest(given, candidates, count);
    if (nearest) return options_wrong(usage, "unknown option %s (did you mean %s?)", given, nearest);
    return options_wrong(usage, "unknown option %s", given);
}

int options_parse(const struct usage *usage, int argc, char **argv, const char **operands)
{
    const int most = usage->operand_maximum ? usage->operand_maximum : 1;
    int count = 0;
    bool only_operands = false;
    for (int i = 0; i < most; i++) operands[i] = NULL;
    for (int i = 1; i < argc; i++) {
        const bool asks_all = !only_operands && strcmp(argv[i], "--help-all") == 0;
        if (asks_all || (!only_operands && (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0))) {
            const struct option_spec *option = usage->options;
            printf("Usage: wiggly %s%s %s\n%s\n", usage->command, option->words ? " [options]" : "", usage->operands,
                   usage->summary);
            if (option->words) printf("\nOptions:\n");
            int left = asks_all || !usage->common_count ? OPTIONS_MOST : usage->common_count;
            for (; option->words && left > 0; left--, option++) printf("  %-26s %s\n", option->words, option->help);
            if (option->words) printf("\nwiggly %s --help-all lists all options.\n", usage->command);
            return OPTIONS_HELP;
        }
        if (!only_operands && strcmp(argv[i], "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argv[i][0] == '-' && argv[i][1]) {
            if (read_option(usage, argc, argv, &i) == OPTIONS_WRONG) return OPTIONS_WRONG;
        } else if (!*argv[i]) {
            return options_wrong(usage, "expected %s, got an empty argument", usage->operands);
        } else if (count < most) {
            operands[count++] = argv[i];
        } else {
            return options_wrong(usage, "'%s' is one argument too many", argv[i]);
        }
    }
    if (count == 0 && usage->operands[0] != '[')
        return options_wrong(usage, "an argument is missing: %s", usage->operands);

    // An output must not be another output, or an input. Devices and pipes may be shared.
    char name[WORD_MAX + 1], other_name[WORD_MAX + 1];
    const char *operand = usage->operands + (usage->operands[0] == '[');
    snprintf(name, sizeof name, "%.*s", (int)strcspn(operand, " ]"), operand);
    for (int i = 0; i < count; i++) file_note_read(operands[i], name);
    for (const struct option_spec *input = usage->options; input->words; input++) {
        split_words(input, name);
        if (input->kind == OPTION_INPUT && *(const char **)input->target)
            file_note_read(*(const char **)input->target, name);
    }
    for (const struct option_spec *one = usage->options; one->words; one++) {
        const char *path = one->kind == OPTION_OUTPUT ? *(const char **)one->target : NULL;
        struct error error;
        split_words(one, name);
        if (path && !file_check_unread(path, &error)) return options_wrong(usage, "%s: %s", name, error.text);
        for (const struct option_spec *other = usage->options; path && other < one; other++) {
            const char *taken = other->kind == OPTION_OUTPUT ? *(const char **)other->target : NULL;
            split_words(other, other_name);
            if (taken && file_same(path, taken))
                return options_wrong(usage, "%s and %s: expected two files, got %s for both", other_name, name, path);
        }
    }
    return OPTIONS_RUN;
}

int options_end(bool done, const struct error *error)
{
    if (!done) fprintf(stderr, "%s\n", error->text);
    return done ? 0 : (int)error->kind;
}

bool options_direction(const char *text, double direction[3])
{
    static const struct {
        const char *name;
        double direction[3];
    } known[] = {{"up", {0, 1, 0}}, {"side", {1, 0, 0}}, {"front", {0, 0, 1}}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcmp(text, known[i].name) != 0) continue;
        memcpy(direction, known[i].direction, sizeof known[i].direction);
        return true;
    }
    int end = 0;
    if (sscanf(text, "%lf,%lf,%lf%n", &direction[0], &direction[1], &direction[2], &end) != 3 || text[end])
        return false;
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    if (!isfinite(length) || !(length > 0)) return false;
    for (int c = 0; c < 3; c++) direction[c] /= length;
    return true;
}
