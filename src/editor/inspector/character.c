/// The inspector's section on a soft character: channels, display, brush.
#include "base/names.h"
#include "base/need.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/parts.h"
#include "rig/models.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_ITEMS = 32 }; ///< coordinates in the add list

/// Selects a channel and the spline that drives it.
static void choose(struct inspector *in, int drive)
{
    const struct character_view *view = &in->core->characters;
    const struct character_rig *rig = document_character(in->core->document, view->character);
    core_choose(in->core, rig->drives[drive].spline);
    in->core->characters.drive = drive; // two channels may share a spline
}

static void build_drives(struct inspector *in, const struct character_rig *rig)
{
    struct ui *ui = &in->ui;
    for (int k = 0; k < rig->drive_count; k++) {
        const struct drive *drive = &rig->drives[k];
        char name[32], remove[32], text[160];
        struct rect r = ui_row(ui, UI_ROW), button = {r.x + r.w - r.h, r.y, r.h, r.h};
        snprintf(name, sizeof name, "drive.%d", k);
        snprintf(remove, sizeof remove, "drive.%d.remove", k);
        snprintf(text, sizeof text, "%.*s, driven by %.*s", name_fit(drive->name, 60), drive->name,
                 name_fit(in->core->document->splines[drive->spline]->name, 60),
                 in->core->document->splines[drive->spline]->name);
        r.w -= r.h + 4;
        ui_hint(ui, r, "A channel of this character, and the spline that drives it");
        const uint32_t color = spline_list_color(in->core->document, drive->spline);
        if (ui_list_row(ui, r, name, text, color, k == in->core->characters.drive)) choose(in, k);
        if (!ui_icon_button(ui, button, remove, UI_ICON_DELETE, false, "Remove this channel")) continue;
        const int owner = characters_rig(in->core);
        if (core_begin(in->core, "Remove channel", 0))
            core_end(in->core, edit_drive_remove(in->core->document, owner, k, &in->core->error));
        return;
    }
}

/// The coordinate the active spline drives, if that is the selected one.
static const void *felt_drive(const struct inspector *in)
{
    const struct character_view *view = &in->core->characters;
    const struct character_rig *rig = document_character(in->core->document, view->character);
    if (!rig || view->drive >= rig->drive_count) return NULL;
    return rig->drives[view->drive].spline == in->core->active ? &rig->drives[view->drive] : NULL;
}

static const struct number_row drive_rows[] = {
    {"drive.lag", "lag", "°", "How far it lags behind the spline; 360 is a full swing", "Set lag",
     NUMBER_AT(struct drive, lag), -180, 180, -36000, 36000, 0, 1, 1},
    {"amplitude", "amplitude", NULL, "How far it swings when the spline is 1", "Set amplitude",
     NUMBER_AT(struct drive, amplitude), -2, 2, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, DRIVE_DEFAULT_AMPLITUDE,
     0.05, 2},
};

static double was_drive(const struct inspector *in, int which)
{
    const struct rig *kept = take_rig(in->core, characters_rig(in->core));
    const int drive = in->core->characters.drive;
    return kept && drive < kept->character.drive_count ? number_at(&drive_rows[which], &kept->character.drives[drive])
                                                       : NAN;
}

/// Edits the selected coordinate's drive.
static bool set_drive(struct inspector *in, const struct drive *drive, struct error *error)
{
    return edit_drive(in->core->document, characters_rig(in->core), in->core->characters.drive, drive, error);
}

/// The lags of a limb's other drives go with it.
static bool set_drive_number(struct inspector *in, int which, double number, struct error *error)
{
    const int owner = characters_rig(in->core), chosen = in->core->characters.drive;
    const struct drive *before = felt_drive(in);
    const double lag = before->lag;
    struct drive drive = *before;
    number_put(&drive_rows[which], &drive, number);
    const int all = drive.lag != lag && inspector_limb(in) == owner ? characters_selected(in->core)->drive_count : 0;
    bool done = set_drive(in, &drive, error);
    for (int k = 0; k < all && done; k++) {
        struct drive other = characters_selected(in->core)->drives[k];
        other.lag = core_in_step(other.lag, lag, drive.lag);
        done = k == chosen || edit_drive(in->core->document, owner, k, &other, error);
    }
    return done;
}

bool inspector_felt_drive(struct inspector *in)
{
    static const struct number_home home = {.of = felt_drive, .set = set_drive_number, .was = was_drive};
    if (!felt_drive(in)) return false;
    inspector_numbers(in, drive_rows, sizeof drive_rows / sizeof drive_rows[0], &home);
    return true;
}

static void choose_spline(struct inspector *in, const struct dropdown *list)
{
    struct drive next = characters_selected(in->core)->drives[in->core->characters.drive];
    next.spline = inspector_spline_list(in, list, next.spline);
    if (next.spline < 0 || !core_begin(in->core, "Set spline", 0)) return;
    if (core_end(in->core, set_drive(in, &next, &in->core->error))) choose(in, in->core->characters.drive);
}

static const struct dropdown spline_list = {"drive.splines", "The spline that drives this channel", choose_spline};

static bool is_driven(const struct character_rig *rig, const char *name)
{
    for (int k = 0; k < rig->drive_count; k++) {
        if (strcmp(rig->drives[k].name, name) == 0) return true;
    }
    return false;
}

/// Lists the figure's undriven coordinates; returns how many.
static int free_coordinates(const struct inspector *in, const struct character_rig *rig,
                            struct ui_item items[MAX_ITEMS])
{
    const struct figure *figure = models_figure(in->core->models, in->core->characters.character);
    int count = 0;
    if (!figure || rig->drive_count == CHARACTER_MAX_DRIVES) return 0;
    for (int k = 0; k < figure->character.coordinate_count && count < MAX_ITEMS; k++) {
        const char *name = figure->character.coordinates[k].name;
        if (!is_driven(rig, name)) items[count++] = (struct ui_item){name, name, 0};
    }
    return count;
}

static void add_coordinate(struct inspector *in, const struct dropdown *list)
{
    struct ui_item items[MAX_ITEMS];
    const int count = free_coordinates(in, characters_selected(in->core), items);
    const int picked = ui_popup_list(&in->ui, list->name, items, count, -1), owner = characters_rig(in->core);
    if (picked < 0) return;
    char *name = need_text(items[picked].name);
    const struct drive drive = {
        .name = name, .spline = in->core->active >= 0 ? in->core->active : 0, .amplitude = DRIVE_DEFAULT_AMPLITUDE};
    if (core_begin(in->core, "Add channel", 0))
        core_end(in->core, edit_drive(in->core->document, owner, -1, &drive, &in->core->error));
    free(name);
}

static const struct dropdown add_list = {"drive.add", "Add a channel that the active spline drives", add_coordinate};

/// The phase map and the stiff twin.
static void build_looks(struct inspector *in)
{
    static const struct ui_choice maps[] = {{"off", "Off"}, {"x", "x"}, {"y", "y"}, {"z", "z"}};
    static const struct ui_choice pairs[] = {{"off", "Off"}, {"on", "Beside it"}};
    struct character_view *view = &in->core->characters;
    int map = view->mapped ? 1 + view->axis : 0, pair = view->compare;
    if (inspector_choice(in, "phases", "Colour each point by its phase along x, y or z", "phases", maps, 4, &map)) {
        view->mapped = map > 0;
        if (map > 0) view->axis = map - 1;
    }
    if (inspector_choice(in, "stiff twin", "Show a second character without phases: all its points move in step",
                         "twin", pairs, 2, &pair)) {
        view->compare = pair;
        in->core->refit_stage = true;
    }
}

/// Analysis results of the selected channel.
static void build_facts(struct inspector *in)
{
    const struct coordinate *c = characters_coordinate(in->core);
    char text[200];
    if (!c) {
        ui_paragraph(&in->ui, "The model has no such channel.", theme()->text_dim);
    } else if (c->frequency > 0) {
        snprintf(text, sizeof text,
                 "Found at %.2f Hz, damping %.3f. It explains %.0f %% of this motion; without phases (real PCA) one "
                 "component explains %.0f %%, two %.0f %%.",
                 c->frequency, c->damping, 100 * c->explained, 100 * c->pca1, 100 * c->pca2);
        ui_paragraph(&in->ui, text, theme()->text_dim);
    }
}

static int shown_rig(const struct inspector *in) { return characters_rig(in->core); }

static const struct number_row floor_rows[] = {
    {"floor.height", "height", "m", "No point of the character goes lower", "Set floor",
     NUMBER_AT(struct rig, character.floor), -1, 0, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, 0, 0.01, 3},
};

/// The floor switch and its height.
static void build_floor(struct inspector *in, const struct character_rig *rig)
{
    static const struct ui_choice choices[] = {{"off", "Off"}, {"on", "On"}};
    static const struct number_home home = {.rig = shown_rig};
    const int owner = characters_rig(in->core);
    int on = rig->has_floor;
    if (inspector_choice(in, "floor", "Keep the whole character above a height", "floor", choices, 2, &on)) {
        struct rig changed = *in->core->document->rigs[owner];
        changed.character.has_floor = on;
        if (on) changed.character.floor = rig->position[1];
        if (core_begin(in->core, on ? "Set floor" : "Remove floor", 0))
            core_end(in->core, edit_rig_set(in->core->document, owner, &changed, &in->core->error));
        return;
    }
    if (!rig->has_floor) return;
    inspector_numbers(in, floor_rows, 1, &home);
    const struct floor_left *left = evaluation_floor(in->core->evaluation, owner);
    if (!left || left->depth < 1e-4) return;
    char text[120];
    snprintf(text, sizeof text, "Up to %.3g m below it, deepest at frame %.6g: knots and pins come first.",
             left->depth, document_frame(in->core->document, left->sample));
    ui_paragraph(&in->ui, text, theme()->text_dim);
}

/// Brush modes of one kind side by side. None is marked if the brush has another kind.
static void build_modes(struct inspector *in, const char *name, const char *hint, enum brush_mode first,
                        const struct ui_choice *choices, int count)
{
    struct brush *brush = &in->core->brush;
    const struct rect r = ui_row(&in->ui, UI_ROW);
    const int chosen = (int)brush->mode - (int)first;
    int index = chosen >= 0 && chosen < count ? chosen : -1;
    ui_hint(&in->ui, r, hint);
    if (ui_segments(&in->ui, r, name, choices, count, &index)) brush->mode = (enum brush_mode)((int)first + index);
}

/// The brush's numbers are fractions, shown in percent.
static double *share_of(const struct inspector *in, int which)
{
    struct brush *brush = &in->core->brush;
    return which == 0 ? &brush->radius : &brush->strength;
}

static double get_share(const struct inspector *in, int which) { return 100 * *share_of(in, which); }

static bool set_share(struct inspector *in, int which, double percent, struct error *error)
{
    (void)error;
    *share_of(in, which) = percent / 100;
    return true;
}

static const struct number_row brush_rows[] = {
    {"radius", "radius", "%", "Radius, relative to the character's height (Ctrl+wheel on the stage)", NULL, 0, false,
     1, 50, 1, 50, 12, 1, 0},
    {"strength", "strength", "%", "How fast paint flows (Shift+wheel on the stage)", NULL, 0, false, 2, 100, 2, 100,
     40, 1, 0},
};

static void build_brush(struct inspector *in)
{
    static const struct ui_choice switches[] = {{"off", "Off"}, {"on", "Brush"}};
    static const struct ui_choice phase[] = {{"advance", "Advance"}, {"delay", "Delay"}, {"smooth", "Smooth"}};
    static const struct ui_choice amplitude[] = {
        {"more", "Swing more"}, {"less", "Swing less"}, {"smooth", "Smooth"}};
    static const struct ui_choice erase[] = {{"all", "Erase"}};
    static const struct number_home home = {.get = get_share, .set = set_share};
    struct brush *brush = &in->core->brush;
    int on = brush->on;
    if (inspector_choice(in, "paint", "Paint phase and amplitude onto the character (Shift+B)", "paint", switches, 2,
                         &on))
        characters_set_brush(in->core, on);
    const struct character_rig *rig = characters_selected(in->core);
    if (brush->on) {
        build_modes(in, "phase", "Move earlier, later, or blend with the surroundings", BRUSH_ADVANCE, phase, 3);
        build_modes(in, "swing", "Swing more, less, or blend with the surroundings", BRUSH_MORE, amplitude, 3);
        build_modes(in, "erase", "Remove paint and restore the model", BRUSH_ERASE, erase, 1);
        inspector_numbers(in, brush_rows, sizeof brush_rows / sizeof brush_rows[0], &home);
    }
    if (!rig || !rig->painted || paint_is_plain(rig->painted)) return;
    const struct rect r = ui_row(&in->ui, UI_ROW);
    ui_hint(&in->ui, r, "Restore the model everywhere");
    if (ui_button(&in->ui, r, "paint.clean", "Remove all paint", false)) characters_clean_paint(in->core, 0);
}

void inspector_character(struct inspector *in)
{
    struct character_view *view = &in->core->characters;
    if (!document_character(in->core->document, view->character)) view->character = 0;
    const struct character_rig *rig = document_character(in->core->document, view->character);
    struct ui_item items[MAX_ITEMS];
    if (view->drive >= rig->drive_count) view->drive = 0;
    build_drives(in, rig);
    if (free_coordinates(in, rig, items) > 0 && in->core->document->spline_count > 0)
        inspector_dropdown(in, &add_list, ui_row(&in->ui, UI_ROW), 0, "Add a channel", 0);
    ui_space(&in->ui, 4);
    if (view->drive < rig->drive_count) {
        inspector_spline_field(in, &spline_list, inspector_labelled(in, "spline"), 0,
                               rig->drives[view->drive].spline);
        build_facts(in);
    }
    build_floor(in, rig);
    build_looks(in);
    inspector_overlays(in);
    build_brush(in);
}
