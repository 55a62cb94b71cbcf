/// The editor: what its panels share, and each panel's own state. Private to the files beside this one, and to tests.
#ifndef EDITOR_STATE_H
#define EDITOR_STATE_H

#include "editor/core/state.h"
#include "ui/tooltip.h"

/// The last key pressed in this frame; its character comes next.
struct press {
    bool used;     ///< a dialog, a drag or a field has used it
    bool repeated; ///< it is kept down
};

struct editor {
    struct core core;
    struct curves *curves;
    struct stage *stage;
    struct inspector *inspector;
    struct dialogs *dialogs;
    struct transport *transport;
    struct press press;
    struct tooltip tooltip;
    struct {
        unsigned serial; ///< of the document
        unsigned active; ///< id of the spline
    } seen;              ///< that the panels were last told of
    bool fitted;         ///< camera and curves view, at the first editor_pose() of a document
};

/// Does what leaves the document, but asks first where work would be lost.
void editor_leave(struct editor *editor, const struct request *request);
/// After each event and edit: the panels follow another document and another active spline.
void editor_settle(struct editor *editor);

#endif
