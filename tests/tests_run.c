/// The tests of a program, which add themselves before main() begins; and the main() of those that have none of their own.
#include "near.h"
#include <assert.h>

static struct {
    struct CMUnitTest test;
    int line;
} added[64];
static size_t count;

void tests_add(struct CMUnitTest test, int line)
{
    assert(count < sizeof added / sizeof *added);
    size_t i = count++;
    for (; i > 0 && added[i - 1].line > line; i--) added[i] = added[i - 1];
    added[i].test = test;
    added[i].line = line;
}

int tests_run(CMFixtureFunction set_up, CMFixtureFunction tear_down)
{
    struct CMUnitTest tests[sizeof added / sizeof *added];
    for (size_t i = 0; i < count; i++) tests[i] = added[i].test;
    return _cmocka_run_group_tests("tests", tests, count, set_up, tear_down);
}

int main(void) { return tests_run(NULL, NULL); }
