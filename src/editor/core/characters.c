/// The selected soft character and its brush.
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "rig/models.h"

const struct character_rig *characters_selected(const struct core *core)
{
    return document_character(core->document, core->characters.character);
}

void characters_open(struct core *core)
{
    const struct character_rig *first = document_character(core->document, 0);
    const int phases = first ? first->phases : -1;
    core->brush.on = false;
    core->characters = (struct character_view){.mapped = phases >= 0, .axis = phases >= 0 ? phases : 1};
}

const struct figure *characters_figure(const struct core *core, int *coordinate)
{
    const struct character_rig *rig = characters_selected(core);
    const struct figure *figure = models_figure(core->models, core->characters.character);
    if (!rig || !figure || core->characters.drive >= rig->drive_count) return NULL;
    *coordinate = figure_find(figure, rig->drives[core->characters.drive].name);
    return *coordinate >= 0 ? figure : NULL;
}

const struct coordinate *characters_coordinate(const struct core *core)
{
    int coordinate;
    const struct figure *figure = characters_figure(core, &coordinate);
    return figure ? &figure->character.coordinates[coordinate] : NULL;
}

/// Shows the phases along the axis of the largest movement, unless another was chosen.
static void choose_axis(struct core *core, const struct figure *figure, int coordinate)
{
    const float *largest = figure->largest[coordinate];
    int axis = 0;
    if (core->characters.mapped) return;
    for (int k = 1; k < 3; k++) {
        if (largest[k] > largest[axis]) axis = k;
    }
    core->characters.axis = axis;
}

void characters_set_brush(struct core *core, bool on)
{
    int coordinate;
    const struct figure *figure = on ? characters_figure(core, &coordinate) : NULL;
    core->brush.on = figure != NULL;
    if (!on) return;
    if (!figure) {
        core_message(core, false, "This scene has no character to paint.");
        return;
    }
    choose_axis(core, figure, coordinate);
    core_message(core, false, "Drag over the character to paint. Ctrl reverses, Shift smooths, Esc ends.");
}

int characters_rig(const struct core *core)
{
    return document_find_rig(core->document, RIG_CHARACTER, core->characters.character);
}

bool characters_blank_paint(struct core *core, const struct figure *figure)
{
    const struct character *character = &figure->character;
    return edit_paint_new(core->document, characters_rig(core), character->coordinate_count, character->vertex_count,
                          &core->error);
}

void characters_clean_paint(struct core *core, int unused)
{
    int coordinate;
    const struct character_rig *rig = characters_selected(core);
    const struct figure *figure = characters_figure(core, &coordinate);
    (void)unused;
    if (!figure || !rig->painted || paint_is_plain(rig->painted)) {
        core_message(core, false, "There is no paint to remove.");
        return;
    }
    if (core_step(core, "Remove paint", 0)) characters_blank_paint(core, figure);
}
