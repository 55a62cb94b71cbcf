/// What a save that never ended has left: a list beside the scene says which of its files of paint a save is about to add and to
/// remove, and is there for as long as the save takes.
#ifndef SCENE_LEFTOVERS_H
#define SCENE_LEFTOVERS_H

#include "base/file.h"

/// The list, locked by who saves; another machine's is left alone while it lives.
struct leftovers {
    const char *scene; ///< the caller's
    int file;          ///< -1: none, as where nothing was noted
    char path[PATH_LIMIT];
};

/// "walk-paint.npy" beside "walk.json" for 1, then "walk-paint-2.npy" …; false where it is too long.
bool leftovers_name(const char *scene, int number, char file[PATH_LIMIT]);

/// Begins a save: removes what an earlier one's list names and no scene in the folder does.
void leftovers_open(struct leftovers *leftovers, const char *scene);

/// Notes a file before it is added or replaced, where it has such a name. Where the disk takes no list, the save goes on without.
void leftovers_note(struct leftovers *leftovers, const char *file);

/// Ends the save, and removes the list.
void leftovers_close(struct leftovers *leftovers);

/// Removes paint, unless a scene in its folder may name it.
void leftovers_remove(const char *file);

#endif
