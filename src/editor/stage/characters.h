/// Soft characters on the stage: how they are looked at. Private to the folder.
#ifndef EDITOR_STAGE_CHARACTERS_H
#define EDITOR_STAGE_CHARACTERS_H

#include "editor/editor.h"

/// View state; zero is a valid start.
struct character_view {
    int character, drive; ///< selected in the inspector
    bool mapped;          ///< the selected coordinate's phases as colours
    int axis;             ///< of movement whose phases are shown: x, y, z
    bool compare;         ///< beside each character its stiff twin, moved by real parts alone
};

/// The rig that is selected, or NULL; and its coordinate.
const struct character_rig *characters_selected(const struct editor *editor, const struct editor_world *world);
const struct coordinate *characters_coordinate(const struct editor *editor, const struct editor_world *world);

/// A new document is on the table: what its first character shows at first.
void characters_open(struct editor *editor, const struct document *document);

/// Where a point of its surface is on the screen: `uv` across and up its box at rest, seen from the front. false where it is not
/// shown.
bool characters_point(const struct editor *editor, int character, const double uv[2], float xy[2]);

/// Where the legend is, when it is shown.
struct rect characters_legend(const struct editor *editor);

/// Legend of the phase map, and what the two of a pair are.
void characters_show(struct editor *editor, const struct editor_world *world);

#endif
