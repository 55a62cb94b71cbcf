/// Motion of a mesh: the positions of all vertices in every frame, in NumPy's .npy, in PC2 (Blender, 3ds Max) and in MDD
/// (LightWave, Blender, Houdini). Read in slabs of columns, so that a file need not fit into memory; written frame by frame.
#ifndef MODEL_MOTION_H
#define MODEL_MOTION_H

#include "base/file.h"
#include <stdint.h>

/// A motion that is open for reading. Column 3v + k is coordinate k (x, y, z) of vertex v.
struct motion {
    int frames, vertices;
    double fps;       ///< frames per second, 0 where the file does not say (.npy and .pc2 never do)
    const char *path; ///< the caller's, for messages
    // private
    int file;
    const char *memory; ///< NULL: a file's
    int64_t data;       ///< where the numbers start
    int number_size;    ///< 4 or 8 bytes
    bool swapped;       ///< big endian
    bool columns_first; ///< all frames of a column lie together (Fortran order)
    int64_t strides[3]; ///< bytes from one frame, vertex, coordinate to the next
};

/// Opens a file and checks its header and its size. .npy: float32 or float64, little or big endian, C or Fortran order,
/// shape (frames, vertices, 3) or (frames, 3 vertices). The format is recognised by content; `path` must outlive the motion.
/// Errors name the path and say what was expected.
bool motion_open(struct motion *motion, const char *path, struct error *error);

/// A motion in memory, frame after frame, which must outlive it. `name` is for messages.
struct motion motion_of_memory(const float (*positions)[3], int frames, int vertices, double fps, const char *name);

/// Reads columns [first, first + count) of all frames: slab[frame · count + column − first]. A number that is not finite is
/// an error that names frame and vertex, both from 0. Uses pread, not mmap: only the
/// slab is in memory, and a file that shrinks meanwhile is an error, not a signal.
bool motion_columns(const struct motion *motion, int first, int count, double *slab, struct error *error);

void motion_close(struct motion *motion);

enum motion_form { MOTION_NPY, MOTION_PC2, MOTION_MDD };

/// The header of a motion to be written; .npy has no times.
struct motion_span {
    int frames, vertices;
    double first, spacing; ///< where the first frame is, and from one to the next: PC2 in frames, MDD in seconds
};

/// The start of a motion, and one frame, into a file that the caller opens and checks. Numbers are float32; .npy has C order and shape
/// (frames, vertices, 3).
void motion_print_start(FILE *out, enum motion_form form, const struct motion_span *span);
void motion_print_frame(FILE *out, enum motion_form form, const float (*position)[3], int vertices);

/// Starts a file of `frames` frames: .npy or, where the path ends in .pc2, PC2. The caller adds the frames (positions as they lie in memory),
/// and commits or discards it.
bool motion_start(struct file_output *output, const char *path, int frames, int vertices, struct error *error);

#endif
