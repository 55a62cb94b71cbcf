/// The command line's table: what is understood, what is refused, and that a refused value leaves its target alone.
#include "commands/options.h"
#include "near.h"

static bool loud;
static const char *out;
static int frames, size[2];
static double scale;
static int method;
static const char *operands[2];

enum { SOLVER_CHAIN = 1, SOLVER_BAND };

static const struct option_spec specs[] = {
    {"--loud", "a flag", OPTION_FLAG, &loud, 0, 0},
    {"-o, --output FILE", "a text", OPTION_TEXT, &out, 0, 0},
    {"--frames N", "a whole number", OPTION_INT, &frames, 1, 100},
    {"--scale S", "a number", OPTION_REAL, &scale, 0.5, 4},
    {"--size WxH", "a size", OPTION_SIZE, size, 16, 8192},
    {"--solver chain|band", "a method", OPTION_WORD, &method, 0, 0},
    {0},
};

static const struct usage usage = {
    .command = "test",
    .operands = "a [b]",
    .summary = "a command of the tests",
    .options = specs,
    .operand_maximum = 2,
};

enum { WORDS_MAX = 16 };

/// Parses a command line written as one string, words apart by one space.
static int parse(const char *line)
{
    static char text[256];
    char *argv[WORDS_MAX + 1] = {"test"};
    int argc = 1;
    loud = false;
    out = NULL;
    frames = size[0] = size[1] = -1;
    scale = -1;
    method = SOLVER_CHAIN;
    strncpy(text, line, sizeof text - 1);
    for (char *word = strtok(text, " "); word && argc < WORDS_MAX; word = strtok(NULL, " ")) argv[argc++] = word;
    return options_parse(&usage, argc, argv, operands);
}

TEST(test_values_in_every_spelling)
{
    assert_int_equal(parse("a --loud -o x --frames=7 --scale 1.5 b --size 1280x720"), OPTIONS_RUN);
    assert_true(loud);
    assert_string_equal(out, "x");
    assert_int_equal(frames, 7);
    assert_near(scale, 1.5, 0);
    assert_int_equal(size[0], 1280);
    assert_int_equal(size[1], 720);
    assert_string_equal(operands[0], "a");
    assert_string_equal(operands[1], "b");
    assert_int_equal(method, SOLVER_CHAIN);
    assert_int_equal(parse("a --solver band"), OPTIONS_RUN);
    assert_int_equal(method, SOLVER_BAND);
    assert_int_equal(parse("a --solver=band --solver=chain"), OPTIONS_RUN);
    assert_int_equal(method, SOLVER_CHAIN);
}

TEST(test_names_that_look_like_options)
{
    assert_int_equal(parse("-- --loud"), OPTIONS_RUN);
    assert_false(loud);
    assert_string_equal(operands[0], "--loud");
    assert_null(operands[1]);
    assert_int_equal(parse("-"), OPTIONS_RUN); // by itself it is a name
    assert_string_equal(operands[0], "-");
    assert_int_equal(parse("a -o --loud"), OPTIONS_RUN); // a value may begin with a dash
    assert_string_equal(out, "--loud");
}

TEST(test_what_is_refused)
{
    const char *lines[] = {
        "",
        "a b c",
        "a --lod",
        "a -x",
        "a --loud=yes",
        "a --frames",
        "a --frames 0",
        "a --frames 101",
        "a --frames 7x",
        "a --frames=",
        "a --out=",
        "a --frames 99999999999999999999",
        "a --scale nan",
        "a --scale 1e400",
        "a --scale 0.4",
        "a --size 1280",
        "a --size 1280x",
        "a --size 8x720",
        "a --size 1280x720x2",
        "a --size 1280x9000",
        "a --solver",
        "a --solver Band",
        "a --solver bands",
        "a --solver=",
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        if (parse(lines[i]) != OPTIONS_WRONG) fail_msg("'%s' was accepted", lines[i]);
        assert_int_equal(frames, -1);
        assert_near(scale, -1, 0);
        assert_int_equal(size[0], -1);
        assert_int_equal(method, SOLVER_CHAIN);
    }
}

TEST(test_nearest_word)
{
    const char *words[] = {"live", "solve", "check"};
    assert_string_equal(options_nearest("slove", words, 3), "solve");
    assert_string_equal(options_nearest("chek", words, 3), "check");
    assert_string_equal(options_nearest("lives", words, 3), "live");
    assert_null(options_nearest("render", words, 3));
    char longest[1000];
    memset(longest, 'x', sizeof longest - 1);
    longest[sizeof longest - 1] = 0;
    assert_null(options_nearest(longest, words, 3));
}
