// Both themes: every text can be read on what it stands on, and the splines are told apart, by colour-blind eyes too.
#include "near.h"
#include "ui/theme.h"
#include <math.h>

static void each_theme(void (*check)(void))
{
    for (int kind = 0; kind < THEME_COUNT; kind++) {
        theme_use((enum theme_kind)kind);
        check();
    }
    theme_use(THEME_DARK);
}

static void assert_contrast(uint32_t color, uint32_t background, float least)
{
    float contrast = theme_contrast(color, background);
    if (contrast < least) {
        print_error("%s theme: #%06X on #%06X has a contrast of %.2f\n", theme()->name, color >> 8, background >> 8,
                    (double)contrast);
    }
    assert_true(contrast >= least);
}

// Black on white is 21, and a grey that the definition gives by hand: #777777 has luminance 0.1845.
static void test_contrast_is_the_definition(void **state)
{
    (void)state;
    assert_near((double)theme_contrast(0x000000FFu, 0xFFFFFFFFu), 21, 1e-5);
    assert_near((double)theme_contrast(0x777777FFu, 0xFFFFFFFFu), 1.05 / 0.2345, 0.01);
    assert_near((double)theme_contrast(0x123456FFu, 0x123456FFu), 1, 1e-6);
}

static void check_text(void)
{
    const struct theme *t = theme();
    const uint32_t texts[] = {t->text, t->text_dim, t->accent, t->warning, t->error};
    const uint32_t under[] = {t->panel, t->raised, t->outside};
    const uint32_t under_text[] = {t->fill, t->hover, t->stage.top, t->stage.bottom, t->stage.ground};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        for (size_t k = 0; k < sizeof under / sizeof *under; k++) assert_contrast(texts[i], under[k], 4.5f);
    }
    for (size_t k = 0; k < sizeof under_text / sizeof *under_text; k++) {
        assert_contrast(t->text, under_text[k], 4.5f);
    }
    assert_contrast(t->text_dim, t->stage.top, 4.5f); // a scene's caption
    assert_contrast(t->panel, t->accent, 4.5f);       // the main button
    assert_contrast(t->panel, t->playhead, 4.5f);     // the frame's tag
}

static void test_text_can_be_read(void **state)
{
    (void)state;
    each_theme(check_text);
}

static void check_lines(void)
{
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        assert_contrast(theme()->spline[i], theme()->panel, 3);
        assert_contrast(theme_readable(theme()->spline[i], theme()->panel, 4.5f), theme()->panel, 4.5f);
        assert_true(theme_spline(theme_spline_rgb(i)) == theme()->spline[i]);
    }
    assert_contrast(theme_spline(0x101010), theme()->panel, 3);
    assert_contrast(theme_spline(0xFFFFF0), theme()->panel, 3);
    assert_contrast(theme()->playhead, theme()->panel, 3);
    assert_contrast(theme()->equilibrium, theme()->panel, 3);
}

static void test_lines_are_seen(void **state)
{
    (void)state;
    each_theme(check_lines);
}

static double linear(uint32_t color, int shift)
{
    double value = (color >> shift & 0xFFu) / 255.0;
    return value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4);
}

static double lab_curve(double t) { return t > 216.0 / 24389 ? cbrt(t) : t * 841 / 108 + 4.0 / 29; }

/// CIE L*a*b* (D65) of a colour as seen with one kind of cone missing (Machado, Oliveira, Fernandes 2009, severity 1),
/// or, for NULL, with all.
static void seen_lab(uint32_t color, const double missing[9], double lab[3])
{
    static const double whole[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double xyz_of[9] = {0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505};
    static const double white[3] = {0.9505, 1, 1.089};
    const double rgb[3] = {linear(color, 24), linear(color, 16), linear(color, 8)};
    const double *m = missing ? missing : whole;
    double seen[3], f[3];
    for (int r = 0; r < 3; r++) {
        double sum = m[3 * r] * rgb[0] + m[3 * r + 1] * rgb[1] + m[3 * r + 2] * rgb[2];
        seen[r] = fmin(fmax(sum, 0), 1);
    }
    for (int r = 0; r < 3; r++) {
        f[r] = lab_curve((xyz_of[3 * r] * seen[0] + xyz_of[3 * r + 1] * seen[1] + xyz_of[3 * r + 2] * seen[2]) /
                         white[r]);
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 500 * (f[0] - f[1]);
    lab[2] = 200 * (f[1] - f[2]);
}

/// ΔE (CIE 1976) of two spline colours; about 2.3 is just noticeable, and thin lines need several times that.
static void assert_apart(int i, int j, const double missing[9], const char *eyes)
{
    double a[3], b[3];
    seen_lab(theme()->spline[i], missing, a);
    seen_lab(theme()->spline[j], missing, b);
    double distance = sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
    if (distance < 15) print_error("%s theme, %s: %d and %d are %.1f apart\n", theme()->name, eyes, i, j, distance);
    assert_true(distance >= 15);
}

static void check_splines(void)
{
    static const double no_red[9] = {0.152286, 1.052583,  -0.204868, 0.114503, 0.786281,
                                     0.099216, -0.003882, -0.048116, 1.051998};
    static const double no_green[9] = {0.367322, 0.860646,  -0.227968, 0.280085, 0.672501,
                                       0.047413, -0.011820, 0.042940,  0.968881};
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        for (int j = 0; j < i; j++) {
            assert_apart(i, j, NULL, "all cones");
            assert_apart(i, j, no_red, "no red cones");
            assert_apart(i, j, no_green, "no green cones");
        }
    }
}

static void test_splines_are_apart(void **state)
{
    (void)state;
    each_theme(check_splines);
}

static void test_names(void **state)
{
    (void)state;
    assert_int_equal(theme_find("dark"), THEME_DARK);
    assert_int_equal(theme_find("light"), THEME_LIGHT);
    assert_int_equal(theme_find("solarised"), -1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_contrast_is_the_definition),
        cmocka_unit_test(test_text_can_be_read),
        cmocka_unit_test(test_lines_are_seen),
        cmocka_unit_test(test_splines_are_apart),
        cmocka_unit_test(test_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
