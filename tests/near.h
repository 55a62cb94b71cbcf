/// TEST(): a test that is named once. assert_near(): doubles within a tolerance, which cmocka 1.1.5 lacks (its assert_float_equal casts to
/// float). Includes cmocka with what it needs, and the plain headers of C; tests include this first.
#ifndef TESTS_NEAR_H
#define TESTS_NEAR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
// The order matters: cmocka.h expects the four above.
#include <cmocka.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// cmocka's fail() macro is in the way of base/error.h's function of that name; fail_msg() is built on it.
#undef fail
#undef fail_msg
#define fail_msg(...) (print_error("ERROR: " __VA_ARGS__), print_error("\n"), _fail(__FILE__, __LINE__))

/// Adds a test of a file, which starts at `line`.
void tests_add(const char *file, int line, struct CMUnitTest test);

/// What runs before the first test of a file and after its last; may be NULL.
void tests_between(const char *file, CMFixtureFunction set_up, CMFixtureFunction tear_down);

/// TESTS_BETWEEN(set_up, tear_down), once a file.
#define TESTS_BETWEEN(set_up, tear_down)                                                                             \
    __attribute__((constructor)) static void add_between(void) { tests_between(__FILE__, set_up, tear_down); }

/// A test with its own set-up and tear-down: TEST_WITH(set_up, tear_down, name) { … }.
#define TEST_WITH(set_up, tear_down, name)                                                                           \
    static void name(void **state);                                                                                  \
    __attribute__((constructor)) static void add_##name(void)                                                        \
    {                                                                                                                \
        tests_add(__FILE__, __LINE__, (struct CMUnitTest){#name, name, set_up, tear_down, NULL});                    \
    }                                                                                                                \
    static void name(__attribute__((unused)) void **state)

/// A test: TEST(name) { … }.
#define TEST(name) TEST_WITH(NULL, NULL, name)

/// A test of something that is opened before and closed after it: TEST_OF(struct session, s, session_open(s, scene), session_close(s),
/// name) { … s->document … }.
#define TEST_OF(type, it, opens, closes, name)                                                                       \
    static void name##_of(type *it);                                                                                 \
    TEST(name)                                                                                                       \
    {                                                                                                                \
        type a_##it = {0}, *it = &a_##it;                                                                            \
        opens;                                                                                                       \
        name##_of(it);                                                                                               \
        closes;                                                                                                      \
    }                                                                                                                \
    static void name##_of(type *it)

/// Whether this is `make test-all`, which may take its time. Otherwise tests do less of the same.
static inline bool is_thorough(void) { return getenv("THOROUGH") && *getenv("THOROUGH"); }

static inline int quick_or_all(int quick, int all) { return is_thorough() ? all : quick; }

/// Fails with the error message if a call fails: assert_done(scene_save(document, path, &error)).
#define assert_done(call)                                                                                            \
    do {                                                                                                             \
        struct error error = {0};                                                                                    \
        if (!(call)) fail_msg("%s", error.text);                                                                     \
    } while (0)

/// Fails unless the call fails with these words in its error message.
#define assert_refusal(call, words)                                                                                  \
    do {                                                                                                             \
        struct error error = {0};                                                                                    \
        assert_false(call);                                                                                          \
        if (!strstr(error.text, words)) fail_msg("'%s' lacks '%s'", error.text, words);                              \
    } while (0)

static inline void assert_near_at(double actual, double expected, double tolerance, const char *what,
                                  const char *file, int line)
{
    double difference = fabs(actual - expected);
    if (difference <= tolerance) return; // false for NaN
    print_error("%s is %.17g, expected %.17g within %g (differs by %g)\n", what, actual, expected, tolerance,
                difference);
    _fail(file, line);
}

/// Fails, printing both, unless |actual − expected| ≤ tolerance. NaN on either side fails.
#define assert_near(actual, expected, tolerance)                                                                     \
    assert_near_at((double)(actual), (double)(expected), (double)(tolerance), #actual, __FILE__, __LINE__)

#endif
