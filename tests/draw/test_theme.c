/// Both themes: every text can be read on what it stands on, controls are seen, and splines and phases are told apart, by
/// colour-blind eyes too.
#include "color.h"
#include "near.h"
#include "ui/theme.h"

/// A test in each theme.
#define THEME_TEST(name)                                                                                             \
    static void name##_in(const struct theme *t);                                                                    \
    TEST(name)                                                                                                       \
    {                                                                                                                \
        for (int kind = 0; kind < THEME_COUNT; kind++) {                                                             \
            theme_use((enum theme_kind)kind);                                                                        \
            name##_in(theme());                                                                                      \
        }                                                                                                            \
        theme_use(THEME_DARK);                                                                                       \
    }                                                                                                                \
    static void name##_in(const struct theme *t)

/// Black on white is 21, and a grey that the definition gives by hand: #777777 has luminance 0.1845.
TEST(contrast_is_the_definition)
{
    assert_near(theme_contrast(0x000000FFu, 0xFFFFFFFFu), 21, 1e-5);
    assert_near(theme_contrast(0x777777FFu, 0xFFFFFFFFu), 1.05 / 0.2345, 0.01);
    assert_near(theme_contrast(0x123456FFu, 0x123456FFu), 1, 1e-6);
    assert_int_equal(theme_find("dark"), THEME_DARK);
    assert_int_equal(theme_find("light"), THEME_LIGHT);
    assert_int_equal(theme_find("solarised"), -1);
}

// --- what lies under texts and controls, as it is seen, in bits

enum {
    PANEL = 1,         ///< of curves, inspector, status line, dialogs, help
    FIELD = 1 << 1,    ///< fields, popups, warnings, a row under the pointer
    OUTSIDE = 1 << 2,  ///< the plot before and after the scene's range
    FILL = 1 << 3,     ///< the filled part of a bar, buttons, a selected row, an icon under the pointer
    HOVER = 1 << 4,    ///< the same under the pointer; the chosen segment
    HELD = 1 << 5,     ///< the filled part of a bar that is dragged
    MARKED = 1 << 6,   ///< selected text
    RANGE = 1 << 7,    ///< the ruler where only a part of the scene plays
    LEGEND = 1 << 8,   ///< of the phase map, over the brightest of the stage
    SKY = 1 << 9,      ///< of the stage, at the top
    HORIZON = 1 << 10, ///< at the bottom
    GROUND = 1 << 11,  ///< where it is brightest
    PRIMARY = 1 << 12, ///< the main button, a toggle that is on
    TAG = 1 << 13,     ///< of the frame
    SURFACES = 14,
    PANELS = PANEL | FIELD | OUTSIDE,
    STAGE = SKY | HORIZON | GROUND | LEGEND
};

static uint32_t surface(int which)
{
    const struct theme *t = theme();
    const uint32_t seen[SURFACES] = {t->panel,
                                     t->raised,
                                     t->outside,
                                     t->fill,
                                     t->hover,
                                     color_blend(theme_fade(t->accent, 0.35f), t->raised),
                                     color_blend(theme_fade(t->accent, 0.3f), t->raised),
                                     color_blend(theme_fade(t->accent, 0.14f), t->panel),
                                     color_blend((t->panel & 0xFFFFFF00u) | 0xD8u, t->stage.ground),
                                     t->stage.top,
                                     t->stage.bottom,
                                     t->stage.ground,
                                     t->accent,
                                     t->playhead};
    return seen[which];
}

/// A colour of the theme and the surfaces on which the app has it.
struct use {
    const char *what;
    uint32_t color;
    int on;
};

static void check_uses(const struct use *uses, size_t count, float least)
{
    for (size_t i = 0; i < count; i++) {
        for (int s = 0; s < SURFACES; s++) {
            const float contrast = theme_contrast(uses[i].color, surface(s));
            if ((uses[i].on >> s & 1) && contrast < least)
                fail_msg("%s theme: %s, #%06X on #%06X, has a contrast of %.2f", theme()->name, uses[i].what,
                         uses[i].color >> 8, surface(s) >> 8, (double)contrast);
        }
    }
}

THEME_TEST(text_can_be_read)
{
    const struct use uses[] = {
        {"text", t->text, PANELS | STAGE | FILL | HOVER | HELD | MARKED | RANGE},
        {"dimmed text", t->text_dim, PANELS | STAGE | FILL | HOVER | RANGE},
        {"accent", t->accent, PANELS},
        {"a warning", t->warning, PANELS},
        {"an error", t->error, PANELS},
        {"what is on accent or a tag", t->panel, PRIMARY | TAG},
    };
    check_uses(uses, sizeof uses / sizeof *uses, 4.5f);
}

/// What shows that there is a control, and its state: WCAG 2.2, success criterion 1.4.11. Grids and hairlines between sections
/// are decoration.
THEME_TEST(controls_are_seen)
{
    const struct use uses[] = {
        {"an outline or a thumb", t->control, PANELS},
        {"an outline under the pointer, a slider's handle or strip, a toggle's knob, an icon or a grip", t->text_dim,
         PANELS | FILL | HOVER | HORIZON | GROUND},
        {"focus, what is chosen, a held handle, or an icon that is lit", t->accent, PANELS | FILL | HOVER},
        {"a refused field", t->error, PANELS},
        {"a toggle's knob", t->panel, PRIMARY},
        {"a grip under the pointer", t->text, PANELS | HORIZON | GROUND},
        {"the playhead, a ring, or a box", t->playhead, PANELS},
        {"the equilibrium", t->equilibrium, PANELS},
        {"a triangle that warns", t->warning, PANELS},
    };
    check_uses(uses, sizeof uses / sizeof *uses, 3);
}

static uint32_t faded(int spline)
{
    return color_blend(theme_fade(theme()->spline[spline], THEME_OTHERS), theme()->panel);
}

THEME_TEST(curves_are_seen)
{
    const struct use odd[] = {{"a spline's own black", theme_spline(0x101010), PANEL},
                              {"a spline's own white", theme_spline(0xFFFFF0), PANEL}};
    check_uses(odd, 2, 3);
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        const uint32_t color = t->spline[i];
        const struct use uses[] = {{"a curve or a swatch", color, PANELS | FILL}, {"another curve", faded(i), PANEL}};
        const struct use name = {"a curve's name", theme_readable(color, t->panel, 4.5f), PANEL};
        check_uses(uses, 2, 3);
        check_uses(&name, 1, 4.5f);
        assert_true(theme_spline(theme_spline_rgb(i)) == color);
    }
}

// --- what is told apart

/// Table 1 of Sharma, Wu and Dalal 2005: pairs at which implementations of CIEDE2000 go wrong.
TEST(differences_are_ciede2000)
{
    static const struct {
        double one[3], other[3], difference;
    } pairs[] = {
        {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
        {{50, -1.3802, -84.2814}, {50, 0, -82.7485}, 1.0000},
        {{50, 0, 0}, {50, -1, 2}, 2.3669},
        {{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792},
        {{50, 2.49, -0.001}, {50, -2.49, 0.0011}, 7.2195},
        {{50, -0.001, 2.49}, {50, 0.0011, -2.49}, 4.7461},
        {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
        {{50, 2.5, 0}, {58, 24, 15}, 19.4535},
        {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
        {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
        {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        assert_near(color_lab_difference(pairs[i].one, pairs[i].other), pairs[i].difference, 5e-5);
        assert_near(color_lab_difference(pairs[i].other, pairs[i].one), pairs[i].difference, 5e-5);
    }
}

/// Greys stay what they are to all eyes; colours that one kind confuses come together.
TEST(eyes_are_blind_to_what_they_should_be)
{
    static const uint32_t confused[EYES_COUNT][2] = {{0, 0},
                                                     {0xA05000FFu, 0x5A5F00FFu},
                                                     {0xC06A00FFu, 0x808000FFu},
                                                     {0x30A0C0FFu, 0x30A890FFu},
                                                     {0xA05000FFu, 0x5A5F00FFu},
                                                     {0xC06A00FFu, 0x808000FFu},
                                                     {0x30A0C0FFu, 0x30A890FFu}};
    for (int i = 0; i < EYES_COUNT; i++) {
        const enum color_eyes eyes = (enum color_eyes)i;
        const uint32_t *pair = confused[i];
        double lab[3];
        color_lab(0x777777FFu, eyes, lab);
        assert_near(lab[0], 50.03, 0.02); // of #777777 by definition: 116 ∛0.1845 − 16
        assert_near(hypot(lab[1], lab[2]), 0, 0.05);
        if (i == EYES_WITH_ALL_CONES) continue;
        const double all = color_difference(pair[0], pair[1], EYES_WITH_ALL_CONES);
        if (!(color_difference(pair[0], pair[1], eyes) < 0.2 * all)) fail_msg("%s", color_eyes_name(eyes));
    }
}

/// Every two of the colours are 10 or more apart to all eyes.
static void assert_apart(const uint32_t *colors, int count, const char *what)
{
    for (int i = 0; i < EYES_COUNT * count * count; i++) {
        const enum color_eyes eyes = (enum color_eyes)(i / count / count);
        const int one = i / count % count, other = i % count;
        const double apart = color_difference(colors[one], colors[other], eyes);
        if (one < other && apart < 10)
            fail_msg("%s theme, %s: %s %d and %d, #%06X and #%06X, are %.1f apart", theme()->name,
                     color_eyes_name(eyes), what, one, other, colors[one] >> 8, colors[other] >> 8, apart);
    }
}

THEME_TEST(splines_are_apart)
{
    uint32_t others[THEME_SPLINE_COLORS];
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) others[i] = faded(i);
    assert_apart(t->spline, THEME_SPLINE_COLORS, "splines");
    assert_apart(others, THEME_SPLINE_COLORS, "splines that are not active");
}

/// All eighths of a turn, not only neighbours, where the amplitude is the largest. Between them the surface has lines:
/// phases_are_the_legends_colours_and_a_line_divides_eighths in test_stage.c.
TEST(phases_are_apart)
{
    uint32_t colors[8];
    for (int i = 0; i < 8; i++) {
        const float angle = 0.785398163f * (float)i;
        colors[i] = phase_color(cosf(angle), sinf(angle));
    }
    assert_apart(colors, 8, "eighths of a turn");
}
