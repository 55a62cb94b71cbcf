/// Parses options from a table, prints help, and suggests the nearest word.
#include "commands/options.h"
#include "base/file.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_MAX = 63, OPTION_MAX = 32 };

static int smaller(int a, int b) { return a < b ? a : b; }

/// Optimal string alignment distance (insertions, deletions, replacements, swaps of neighbours), with three rows of its table. Words are
/// cut at WORD_MAX.
static int edit_distance(const char *a, const char *b)
{
    int rows[3][WORD_MAX + 1];
    int *two_ago = rows[0], *before = rows[1], *row = rows[2];
    int a_length = (int)strnlen(a, WORD_MAX), b_length = (int)strnlen(b, WORD_MAX);
    for (int j = 0; j <= b_length; j++) row[j] = j;
    for (int i = 1; i <= a_length; i++) {
        int *free_row = two_ago;
        two_ago = before;
        before = row;
        row = free_row;
        row[0] = i;
        for (int j = 1; j <= b_length; j++) {
            row[j] = before[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = smaller(row[j], 1 + smaller(before[j], row[j - 1]));
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped) row[j] = smaller(row[j], two_ago[j - 2] + 1);
        }
    }
    return row[b_length];
}

const char *options_nearest(const char *word, const char *const *candidates, int count)
{
    const char *nearest = NULL;
    int best = (int)strnlen(word, WORD_MAX) / 3 + 1; // a larger distance means another word
    for (int i = 0; i < count; i++) {
        int distance = edit_distance(word, candidates[i]);
        if (distance < best) {
            best = distance;
            nearest = candidates[i];
        }
    }
    return nearest;
}

enum options_result options_wrong(const struct usage *usage, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    print_line(stderr, "wiggly %s: %s; see wiggly %s --help", usage->command, text, usage->command);
    return OPTIONS_WRONG;
}

/// Parses an integer in [minimum, maximum] that ends at `end`.
static bool read_int(const char *text, char end, double minimum, double maximum, int *value, const char **rest)
{
    char *stop;
    errno = 0;
    long number = strtol(text, &stop, 10);
    if (stop == text || *stop != end || errno || (double)number < minimum || (double)number > maximum) return false;
    if (number < INT_MIN || number > INT_MAX) return false;
    *value = (int)number;
    *rest = stop;
    return true;
}

static enum options_result store_value(const struct usage *usage, const struct option_spec *option, const char *text)
{
    const char *rest;
    double low = option->minimum, high = option->maximum;
    switch (option->kind) {
    case OPTION_FLAG:
        *(bool *)option->target = true;
        return OPTIONS_RUN;
    case OPTION_TEXT:
    case OPTION_INPUT:
    case OPTION_OUTPUT:
        if (!*text) return options_wrong(usage, "%s: expected %s, got nothing", option->name, option->argument);
        *(const char **)option->target = text;
        return OPTIONS_RUN;
    case OPTION_LIST: {
        struct option_list *list = option->target;
        if (!*text) return options_wrong(usage, "%s: expected %s, got nothing", option->name, option->argument);
        if (list->count == OPTION_LIST_MOST)
            return options_wrong(usage, "%s: expected at most %d times, got more", option->name, OPTION_LIST_MOST);
        list->text[list->count++] = text;
        return OPTIONS_RUN;
    }
    case OPTION_INT:
        if (read_int(text, 0, low, high, option->target, &rest)) return OPTIONS_RUN;
        return options_wrong(usage, "%s: expected a whole number from %.10g to %.10g, got '%s'", option->name, low,
                             high, text);
    case OPTION_REAL: {
        char *stop;
        const double number = strtod(text, &stop);
        if (stop != text && !*stop && isfinite(number) && number >= low && number <= high) {
            *(double *)option->target = number;
            return OPTIONS_RUN;
        }
        return options_wrong(usage, "%s: expected a number from %.10g to %.10g, got '%s'", option->name, low, high,
                             text);
    }
    case OPTION_SIZE: {
        int size[2];
        if (read_int(text, 'x', low, high, &size[0], &rest) && read_int(rest + 1, 0, low, high, &size[1], &rest)) {
            memcpy(option->target, size, sizeof size);
            return OPTIONS_RUN;
        }
        return options_wrong(usage, "%s: expected WIDTHxHEIGHT, each from %.10g to %.10g, got '%s'", option->name,
                             low, high, text);
    }
    case OPTION_WORD: { // the index of one of "a|b|c", from 1
        char list[2 * WORD_MAX] = "";
        const size_t length = strlen(text);
        int number = 0;
        for (const char *word = option->argument; *word;) {
            const size_t span = strcspn(word, "|"), used = strlen(list);
            number++;
            if (span == length && strncmp(word, text, span) == 0) {
                *(int *)option->target = number;
                return OPTIONS_RUN;
            }
            const char *next = word + span + (word[span] == '|'), *joint = !*next              ? ""
                                                                           : strchr(next, '|') ? ", "
                                                                                               : " or ";
            snprintf(list + used, sizeof list - used, "%.*s%s", (int)span, word, joint);
            word = next;
        }
        return options_wrong(usage, "%s: expected %s, got '%s'", option->name, list, text);
    }
    }
    return OPTIONS_WRONG;
}

/// Parses the option at argv[*at] and its value. *at ends on the last word used.
static enum options_result read_option(const struct usage *usage, int argc, char **argv, int *at)
{
    const char *word = argv[*at];
    const char *equals = word[1] == '-' ? strchr(word, '=') : NULL;
    size_t length = equals ? (size_t)(equals - word) : strlen(word);
    const struct option_spec *option = NULL;
    for (int i = 0; i < usage->option_count && !option; i++) {
        const struct option_spec *one = &usage->options[i];
        const bool named = strlen(one->name) == length && strncmp(word, one->name, length) == 0;
        if (named || (one->alias && strcmp(word, one->alias) == 0)) option = one;
    }
    if (!option) {
        const char *names[OPTION_MAX + 1];
        int count = 0;
        for (int i = 0; i < usage->option_count && i < OPTION_MAX; i++) names[count++] = usage->options[i].name;
        names[count++] = "--help";
        char given[WORD_MAX + 1];
        snprintf(given, sizeof given, "%.*s", (int)length, word);
        const char *nearest = options_nearest(given, names, count);
        if (nearest) return options_wrong(usage, "unknown option %s (did you mean %s?)", given, nearest);
        return options_wrong(usage, "unknown option %s", given);
    }
    if (option->kind == OPTION_FLAG) {
        if (equals) return options_wrong(usage, "%s takes no value", option->name);
        return store_value(usage, option, NULL);
    }
    if (equals) return store_value(usage, option, equals + 1);
    if (*at + 1 >= argc) return options_wrong(usage, "%s needs a value: %s", option->name, option->argument);
    return store_value(usage, option, argv[++*at]);
}

enum options_result options_parse(const struct usage *usage, int argc, char **argv, const char **operands)
{
    int count = 0;
    bool only_operands = false;
    for (int i = 0; i < usage->operand_maximum; i++) operands[i] = NULL;
    for (int i = 1; i < argc; i++) {
        const bool asks_all = !only_operands && strcmp(argv[i], "--help-all") == 0;
        if (asks_all || (!only_operands && (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0))) {
            const int shown = asks_all || !usage->common_count ? usage->option_count : usage->common_count;
            printf("Usage: wiggly %s%s %s\n%s\n", usage->command, usage->option_count ? " [options]" : "",
                   usage->operands, usage->summary);
            if (usage->option_count) printf("\nOptions:\n");
            for (int o = 0; o < shown; o++) {
                const struct option_spec *option = &usage->options[o];
                char left[WORD_MAX + 1];
                snprintf(left, sizeof left, "%s%s%s%s%s", option->alias ? option->alias : "",
                         option->alias ? ", " : "", option->name, option->argument ? " " : "",
                         option->argument ? option->argument : "");
                printf("  %-26s %s\n", left, option->help);
            }
            if (shown < usage->option_count) printf("\nwiggly %s --help-all lists all options.\n", usage->command);
            return OPTIONS_HELP;
        }
        if (!only_operands && strcmp(argv[i], "--") == 0) {
            only_operands = true;
        } else if (!only_operands && argv[i][0] == '-' && argv[i][1]) {
            if (read_option(usage, argc, argv, &i) == OPTIONS_WRONG) return OPTIONS_WRONG;
        } else if (!*argv[i]) {
            return options_wrong(usage, "expected %s, got an empty argument", usage->operands);
        } else if (count < usage->operand_maximum) {
            operands[count++] = argv[i];
        } else {
            return options_wrong(usage, "'%s' is one argument too many", argv[i]);
        }
    }
    if (count == 0 && usage->operands[0] != '[')
        return options_wrong(usage, "an argument is missing: %s", usage->operands);

    // An output must not be another output, or an input. Devices and pipes may be shared.
    static char operand[WORD_MAX + 1];
    const char *word = usage->operands + (usage->operands[0] == '[');
    snprintf(operand, sizeof operand, "%.*s", (int)strcspn(word, " ]"), word);
    for (int i = 0; i < usage->operand_maximum && operands[i]; i++) file_note_read(operands[i], operand);
    for (int i = 0; i < usage->option_count; i++) {
        const struct option_spec *input = &usage->options[i];
        const char *path = input->kind == OPTION_INPUT ? *(const char **)input->target : NULL;
        if (path) file_note_read(path, input->name);
    }
    for (int i = 0; i < usage->option_count; i++) {
        const struct option_spec *one = &usage->options[i];
        const char *path = one->kind == OPTION_OUTPUT ? *(const char **)one->target : NULL;
        struct error error;
        if (path && !file_check_unread(path, &error)) return options_wrong(usage, "%s: %s", one->name, error.text);
        for (int k = 0; path && k < i; k++) {
            const struct option_spec *other = &usage->options[k];
            const char *taken = other->kind == OPTION_OUTPUT ? *(const char **)other->target : NULL;
            if (taken && file_same(path, taken))
                return options_wrong(usage, "%s and %s: expected two files, got %s for both", other->name, one->name,
                                     path);
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
