/// Writes motions frame by frame, as .npy or PC2.
#include "base/npy.h"
#include "model/motion.h"
#include "model/motion_format.h"
#include <errno.h>
#include <string.h>
#include <strings.h>

static void write_npy_header(FILE *out, int frames, int vertices)
{
    char header[NPY_HEADER];
    npy_print_header((const int[]){frames, vertices, 3}, 3, header);
    fwrite(header, 1, sizeof header, out);
}

static void write_pc2_header(FILE *out, int frames, int vertices)
{
    const int32_t before[2] = {1, vertices}, after = frames;
    const float first_frame_and_step[2] = {0, 1};
    fwrite(pc2_magic, 1, sizeof pc2_magic, out);
    fwrite(before, 4, 2, out);
    fwrite(first_frame_and_step, 4, 2, out);
    fwrite(&after, 4, 1, out);
}

bool motion_write_open(struct motion_writer *writer, const char *path, int frames, int vertices, struct error *error)
{
    *writer = (struct motion_writer){.frames = frames, .vertices = vertices};
    if (!file_output_open(&writer->output, path, error)) return false;
    const char *dot = strrchr(path, '.');
    if (dot && strcasecmp(dot, ".pc2") == 0) {
        write_pc2_header(writer->output.stream, frames, vertices);
    } else {
        write_npy_header(writer->output.stream, frames, vertices);
    }
    return true;
}

bool motion_write_frame(struct motion_writer *writer, const float (*position)[3], struct error *error)
{
    size_t count = (size_t)writer->vertices;
    if (fwrite(position, sizeof *position, count, writer->output.stream) != count)
        return fail(error, ERROR_ENVIRONMENT, "%s: cannot be written: %s", writer->output.path, strerror(errno));
    writer->written++;
    return true;
}

bool motion_write_commit(struct motion_writer *writer, struct error *error)
{
    if (writer->written == writer->frames) return file_output_commit(&writer->output, error);
    fail(error, ERROR_ENVIRONMENT, "%s: expected %d frames, got %d", writer->output.path, writer->frames,
         writer->written);
    motion_write_discard(writer);
    return false;
}

void motion_write_discard(struct motion_writer *writer) { file_output_discard(&writer->output); }
