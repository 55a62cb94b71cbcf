/// Finds texts that are cut off, covered or too faint.
#include "legible.h"
#include "color.h"
#include "near.h"
#include "ui/font.h"

static const char *text_of(const struct drawlist *list, const struct draw_command *command)
{
    return list->text + command->first;
}

enum { MAX_TEXTS = 1024 };

/// A text that is seen.
struct text {
    int command;
    struct rect ink;
};

/// From the height of its capitals to a little below the baseline, as far as the clip lets it be seen.
static struct rect ink(const struct drawlist *list, const struct draw_command *command)
{
    float up = font_cap_height(command->font, command->width);
    struct rect r = {command->x, command->y - up, font_width(command->font, command->width, text_of(list, command)),
                     up + 1};
    return rect_intersect(r, command->clip);
}

static bool is_empty(struct rect r) { return r.w <= 0.5f || r.h <= 0.5f; }

static bool covers(struct rect over, struct rect r)
{
    return over.x <= r.x + 0.5f && over.y <= r.y + 0.5f && over.x + over.w >= r.x + r.w - 0.5f &&
           over.y + over.h >= r.y + r.h - 0.5f;
}

static bool is_fill(const struct draw_command *command)
{
    return command->kind == DRAW_RECT || command->kind == DRAW_CONVEX;
}

/// Whether something opaque was painted over `r` between two commands.
static bool is_hidden(const struct drawlist *list, int after, int before, struct rect r)
{
    for (int i = after + 1; i < before; i++) {
        const struct draw_command *c = &list->commands[i];
        if (is_fill(c) && (c->color & 0xFFu) == 0xFFu && covers(c->bounds, r)) return true;
    }
    return false;
}

/// The contrast of a text over `base` with all that was painted over it there before.
static float contrast_over(const struct drawlist *list, const struct text *text, uint32_t base)
{
    const int at = text->command;
    const struct rect middle = {text->ink.x + text->ink.w / 2, text->ink.y + text->ink.h / 2, 0, 0};
    uint32_t color = base;
    for (int i = 0; i < at; i++) {
        const struct draw_command *c = &list->commands[i];
        if (is_fill(c) && covers(c->bounds, middle)) color = color_blend(c->color, color);
    }
    return theme_contrast(color_blend(list->commands[at].color, color), color);
}

static float contrast_of(const struct drawlist *list, const struct text *text, const struct legible_ground *ground)
{
    const struct rect r = text->ink;
    const struct stage_colors *stage = &theme()->stage;
    if (!rect_contains(ground->stage, r.x + r.w / 2, r.y + r.h / 2)) return contrast_over(list, text, theme()->panel);
    const uint32_t fur[] = {0xF2D3ACFF, 0x14100CFF}; // the brightest and the darkest of a character
    const uint32_t below[] = {stage->top, stage->bottom, stage->ground, fur[0], fur[1]};
    float least = INFINITY;
    for (int i = 0; i < 5; i++) least = fminf(least, contrast_over(list, text, below[i]));
    return least;
}

static int check_place(const struct drawlist *list, const struct draw_command *c, const struct legible_ground *ground,
                       const char *screen)
{
    const char *text = text_of(list, c);
    const float width = font_width(c->font, c->width, text);
    const struct rect clip = rect_intersect(c->clip, ground->window);
    const bool inside = c->x >= clip.x - 0.5f && c->x + width <= clip.x + clip.w + 0.5f;
    const bool cut = c->count > 4 && strcmp(text + c->count - 3, "…") == 0 && text[c->count - 4] != ' ';
    if (!inside) print_error("%s: “%s” is clipped at its side\n", screen, text);
    if (ground->whole && cut) print_error("%s: “%s” is cut short\n", screen, text);
    return !inside + (ground->whole && cut);
}

static int check_apart(const struct drawlist *list, const struct text *texts, int at, const char *screen)
{
    int count = 0;
    for (int i = 0; i < at; i++) {
        struct rect both = rect_intersect(texts[at].ink, texts[i].ink);
        if (is_empty(both) || is_hidden(list, texts[i].command, texts[at].command, both)) continue;
        print_error("%s: “%s” lies over “%s”\n", screen, text_of(list, &list->commands[texts[at].command]),
                    text_of(list, &list->commands[texts[i].command]));
        count++;
    }
    return count;
}

/// The texts that are seen.
static int collect(const struct drawlist *list, struct text texts[MAX_TEXTS])
{
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        if (list->commands[i].kind != DRAW_TEXT) continue;
        struct text text = {i, ink(list, &list->commands[i])};
        if (is_empty(text.ink) || is_hidden(list, i, list->count, text.ink)) continue;
        assert_true(count < MAX_TEXTS);
        texts[count++] = text;
    }
    return count;
}

int legible_problems(const struct drawlist *list, const struct legible_ground *ground, const char *screen)
{
    struct text texts[MAX_TEXTS];
    int problems = 0, count = collect(list, texts);
    if (list->overflow) {
        print_error("%s: the draw list is full\n", screen);
        problems++;
    }
    for (int i = 0; i < count; i++) {
        const struct draw_command *command = &list->commands[texts[i].command];
        problems += check_place(list, command, ground, screen) + check_apart(list, texts, i, screen);
        float contrast = contrast_of(list, &texts[i], ground);
        if (contrast >= 4.5f) continue;
        print_error("%s: “%s” has a contrast of %.2f\n", screen, text_of(list, command), (double)contrast);
        problems++;
    }
    return problems;
}
