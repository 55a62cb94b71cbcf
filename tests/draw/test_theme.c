/// Both themes: every text can be read on what it stands on, controls are seen, and splines and phases are told apart, by
/// colour-blind eyes too.
#include "color.h"
#include "near.h"
#include "ui/theme.h"

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
TEST(test_contrast_is_the_definition)
{
    assert_near((double)theme_contrast(0x000000FFu, 0xFFFFFFFFu), 21, 1e-5);
    assert_near((double)theme_contrast(0x777777FFu, 0xFFFFFFFFu), 1.05 / 0.2345, 0.01);
    assert_near((double)theme_contrast(0x123456FFu, 0x123456FFu), 1, 1e-6);
}

/// What lies under texts and controls, as it is seen.
enum surface {
    PANEL,   ///< of curves, inspector, status line, dialogs, help
    FIELD,   ///< fields, popups, warnings, a row under the pointer, the plot of poles
    OUTSIDE, ///< the plot before and after the scene's range
    FILL,    ///< the filled part of a bar, buttons, a selected row, an icon under the pointer
    HOVER,   ///< the same under the pointer; the chosen segment
    HELD,    ///< the filled part of a bar that is dragged
    MARKED,  ///< selected text
    RANGE,   ///< the ruler where only a part of the scene plays
    LEGEND,  ///< of the phase map, over the brightest of the stage
    SKY,     ///< of the stage, at the top
    HORIZON, ///< at the bottom
    GROUND,  ///< where it is brightest
    PRIMARY, ///< the main button, a toggle that is on
    TAG,     ///< of the frame
    SURFACES
};

static uint32_t surface(enum surface which)
{
    const struct theme *t = theme();
    const uint32_t legend = (t->panel & 0xFFFFFF00u) | 0xD8u;
    const uint32_t seen[SURFACES] = {[PANEL] = t->panel,
                                     [FIELD] = t->raised,
                                     [OUTSIDE] = t->outside,
                                     [FILL] = t->fill,
                                     [HOVER] = t->hover,
                                     [HELD] = color_blend(theme_fade(t->accent, 0.35f), t->raised),
                                     [MARKED] = color_blend(theme_fade(t->accent, 0.3f), t->raised),
                                     [RANGE] = color_blend(theme_fade(t->accent, 0.14f), t->panel),
                                     [LEGEND] = color_blend(legend, t->stage.ground),
                                     [SKY] = t->stage.top,
                                     [HORIZON] = t->stage.bottom,
                                     [GROUND] = t->stage.ground,
                                     [PRIMARY] = t->accent,
                                     [TAG] = t->playhead};
    return seen[which];
}

/// A colour of the theme and the surfaces, as bits, on which the app has it.
struct use {
    const char *what;
    uint32_t color;
    unsigned on;
};

static void check_uses(const struct use *uses, size_t count, float least)
{
    for (size_t i = 0; i < count; i++) {
        for (int s = 0; s < SURFACES; s++) {
            if (!(uses[i].on >> s & 1u)) continue;
            const float contrast = theme_contrast(uses[i].color, surface((enum surface)s));
            if (contrast >= least) continue;
            fail_msg("%s theme: %s, #%06X on #%06X, has a contrast of %.2f", theme()->name, uses[i].what,
                     uses[i].color >> 8, surface((enum surface)s) >> 8, (double)contrast);
        }
    }
}

#define ON(surface) (1u << (surface))

static void check_text(void)
{
    const struct theme *t = theme();
    const unsigned panels = ON(PANEL) | ON(FIELD) | ON(OUTSIDE),
                   stage = ON(SKY) | ON(HORIZON) | ON(GROUND) | ON(LEGEND);
    const struct use uses[] = {
        {"text", t->text, panels | stage | ON(FILL) | ON(HOVER) | ON(HELD) | ON(MARKED) | ON(RANGE)},
        {"dimmed text", t->text_dim, panels | stage | ON(FILL) | ON(HOVER) | ON(RANGE)},
        {"accent", t->accent, panels},
        {"a warning", t->warning, panels},
        {"an error", t->error, panels},
        {"what is on accent or a tag", t->panel, ON(PRIMARY) | ON(TAG)},
    };
    check_uses(uses, sizeof uses / sizeof *uses, 4.5f);
}

TEST(test_text_can_be_read) { each_theme(check_text); }

/// What shows that there is a control, and its state: WCAG 2.2, success criterion 1.4.11. Grids and hairlines between sections
/// are decoration.
static void check_controls(void)
{
    const struct theme *t = theme();
    const unsigned panels = ON(PANEL) | ON(FIELD) | ON(OUTSIDE);
    const struct use uses[] = {
        {"an outline or a thumb", t->control, panels},
        {"an outline under the pointer, a slider's handle or strip, a toggle's knob, an icon or a grip", t->text_dim,
         panels | ON(FILL) | ON(HOVER) | ON(HORIZON) | ON(GROUND)},
        {"focus, what is chosen, a held handle, or an icon that is lit", t->accent, panels | ON(FILL) | ON(HOVER)},
        {"a refused field", t->error, panels},
        {"a toggle's knob", t->panel, ON(PRIMARY)},
        {"a grip under the pointer", t->text, panels | ON(HORIZON) | ON(GROUND)},
        {"the playhead, a ring, or a box", t->playhead, panels},
        {"the equilibrium", t->equilibrium, panels},
        {"a triangle that warns", t->warning, panels},
    };
    check_uses(uses, sizeof uses / sizeof *uses, 3);
}

TEST(test_controls_are_seen) { each_theme(check_controls); }

static void check_curves(void)
{
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        const uint32_t color = theme()->spline[i];
        const uint32_t other = color_blend(theme_fade(color, THEME_OTHERS), theme()->panel);
        const struct use use[] = {{"a curve or a swatch", color, ON(PANEL) | ON(FIELD) | ON(OUTSIDE) | ON(FILL)},
                                  {"another curve", other, ON(PANEL)}};
        check_uses(use, 2, 3);
        assert_contrast(theme_readable(color, theme()->panel, 4.5f), theme()->panel, 4.5f);
        assert_true(theme_spline(theme_spline_rgb(i)) == color);
    }
    assert_contrast(theme_spline(0x101010), theme()->panel, 3);
    assert_contrast(theme_spline(0xFFFFF0), theme()->panel, 3);
}

TEST(test_curves_are_seen) { each_theme(check_curves); }

/// Table 1 of Sharma, Wu and Dalal 2005: pairs at which implementations of CIEDE2000 go wrong.
TEST(test_differences_are_ciede2000)
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
TEST(test_eyes_are_blind_to_what_they_should_be)
{
    static const struct {
        enum color_eyes eyes;
        uint32_t one, other;
    } confused[] = {
        {EYES_PROTANOPIA, 0xA05000FFu, 0x5A5F00FFu},           {EYES_DEUTERANOPIA, 0xC06A00FFu, 0x808000FFu},
        {EYES_TRITANOPIA, 0x30A0C0FFu, 0x30A890FFu},           {EYES_PROTANOPIA_BRETTEL, 0xA05000FFu, 0x5A5F00FFu},
        {EYES_DEUTERANOPIA_BRETTEL, 0xC06A00FFu, 0x808000FFu}, {EYES_TRITANOPIA_BRETTEL, 0x30A0C0FFu, 0x30A890FFu},
    };
    for (int eyes = 0; eyes < EYES_COUNT; eyes++) {
        double lab[3];
        color_lab(0x777777FFu, (enum color_eyes)eyes, lab);
        assert_near(lab[0], 50.03, 0.02); // of #777777 by definition: 116 ∛0.1845 − 16
        assert_near(hypot(lab[1], lab[2]), 0, 0.05);
    }
    for (size_t i = 0; i < sizeof confused / sizeof *confused; i++) {
        const double all = color_difference(confused[i].one, confused[i].other, EYES_WITH_ALL_CONES);
        const double seen = color_difference(confused[i].one, confused[i].other, confused[i].eyes);
        assert_true(seen < 0.2 * all);
    }
}

/// Every two of the colours are 10 or more apart to all eyes.
static void assert_apart(const uint32_t *colors, int count, const char *what)
{
    for (int eyes = 0; eyes < EYES_COUNT; eyes++) {
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < i; j++) {
                const double apart = color_difference(colors[i], colors[j], (enum color_eyes)eyes);
                if (apart >= 10) continue;
                fail_msg("%s theme, %s: %s %d and %d, #%06X and #%06X, are %.1f apart", theme()->name,
                         color_eyes_name((enum color_eyes)eyes), what, j, i, colors[j] >> 8, colors[i] >> 8, apart);
            }
        }
    }
}

static void check_splines(void)
{
    uint32_t others[THEME_SPLINE_COLORS];
    for (int i = 0; i < THEME_SPLINE_COLORS; i++)
        others[i] = color_blend(theme_fade(theme()->spline[i], THEME_OTHERS), theme()->panel);
    assert_apart(theme()->spline, THEME_SPLINE_COLORS, "splines");
    assert_apart(others, THEME_SPLINE_COLORS, "splines that are not active");
}

TEST(test_splines_are_apart) { each_theme(check_splines); }

/// All eighths of a turn, not only neighbours, where the amplitude is the largest. Between them the surface has lines:
/// phases_are_the_legends_colours_and_a_line_divides_eighths in test_stage.c.
TEST(test_phases_are_apart)
{
    enum { PHASES = 8 };
    uint32_t colors[PHASES];
    for (int i = 0; i < PHASES; i++) {
        const float angle = 0.785398163f * (float)i;
        colors[i] = phase_color(cosf(angle), sinf(angle));
    }
    assert_apart(colors, PHASES, "eighths of a turn");
}

TEST(test_names)
{
    assert_int_equal(theme_find("dark"), THEME_DARK);
    assert_int_equal(theme_find("light"), THEME_LIGHT);
    assert_int_equal(theme_find("solarised"), -1);
}
