/// The mouse cursors that the editor asks for and the platform shows.
#ifndef UI_CURSOR_H
#define UI_CURSOR_H

enum cursor { CURSOR_ARROW, CURSOR_HAND, CURSOR_HORIZONTAL, CURSOR_VERTICAL, CURSOR_MOVE, CURSOR_TEXT };

#endif
