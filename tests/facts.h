/// What a thing holds, as the row of a table: words, and the numbers that each of them must have, ~ for within 1e-6.
#ifndef TESTS_FACTS_H
#define TESTS_FACTS_H

#include "near.h"

enum { FACTS_NUMBERS = 256, FACTS_LOOKED = -2 }; ///< the most numbers of a word

/// Writes the numbers of a word of a thing and returns how many there are; −1: there is no such word; FACTS_LOOKED: with the row's numbers it
/// says where the next words look.
typedef int facts_reader(void *thing, const char *word, const double *given, double *out);

/// Numbers of a word: all floats at an address, none at NULL.
static inline int take_floats(const void *from, int count, double *out)
{
    assert_true(count <= FACTS_NUMBERS);
    for (int k = 0; from && k < count; k++) out[k] = (double)((const float *)from)[k];
    return from ? count : 0;
}

static inline int take_whole(double number, double *out)
{
    out[0] = number;
    return 1;
}

/// Each word of `facts` has the numbers behind it, up to a | if there is one. `row` says whose facts they are.
static inline void assert_facts_of(void *thing, facts_reader *read, const char *row, const char *facts)
{
    for (const char *at = facts; *at && *at != '|';) {
        double given[FACTS_NUMBERS], actual[FACTS_NUMBERS], within[FACTS_NUMBERS];
        char word[16];
        int count = 0, used;
        assert_int_equal(sscanf(at, " %15[a-z] %n", word, &used), 1);
        for (at += used; strchr("~-.0123456789", *at) && *at; count++) {
            char *end;
            assert_true(count < FACTS_NUMBERS);
            within[count] = *at == '~' ? 1e-6 : 0;
            given[count] = (double)strtof(at + (*at == '~'), &end);
            at = end + strspn(end, " ");
        }
        const int found = read(thing, word, given, actual);
        if (found == FACTS_LOOKED) continue;
        if (found != count) fail_msg("%s: %d numbers of \"%s\", expected %d", row, found, word, count);
        for (int i = 0; i < count; i++) {
            if (!(fabs(actual[i] - given[i]) <= within[i]))
                fail_msg("%s: number %d of \"%s\" is %.9g, expected %.9g", row, i, word, actual[i], given[i]);
        }
    }
}

#endif
