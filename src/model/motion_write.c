/// Writes motions frame by frame.
#include "base/npy.h"
#include "model/motion.h"
#include "model/motion_format.h"
#include <errno.h>
#include <string.h>
#include <strings.h>

static void print_npy_start(FILE *out, const struct motion_span *span)
{
    char header[NPY_HEADER];
    npy_print_header((const int[]){span->frames, span->vertices, 3}, 3, header);
    fwrite(header, 1, sizeof header, out);
}

static void print_pc2_start(FILE *out, const struct motion_span *span)
{
    const int32_t before[2] = {1, span->vertices}, after = span->frames;
    const float time[2] = {(float)span->first, (float)span->spacing};
    fwrite(pc2_magic, 1, sizeof pc2_magic, out);
    fwrite(before, 4, 2, out);
    fwrite(time, 4, 2, out);
    fwrite(&after, 4, 1, out);
}

static void print_swapped(FILE *out, uint32_t bits)
{
    bits = __builtin_bswap32(bits);
    fwrite(&bits, sizeof bits, 1, out);
}

static void print_swapped_float(FILE *out, float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    print_swapped(out, bits);
}

static void print_mdd_start(FILE *out, const struct motion_span *span)
{
    print_swapped(out, (uint32_t)span->frames);
    print_swapped(out, (uint32_t)span->vertices);
    for (int i = 0; i < span->frames; i++) print_swapped_float(out, (float)(span->first + i * span->spacing));
}

void motion_print_start(FILE *out, enum motion_form form, const struct motion_span *span)
{
    switch (form) {
    case MOTION_NPY:
        print_npy_start(out, span);
        break;
    case MOTION_PC2:
        print_pc2_start(out, span);
        break;
    case MOTION_MDD:
        print_mdd_start(out, span);
        break;
    }
}

void motion_print_frame(FILE *out, enum motion_form form, const float (*position)[3], int vertices)
{
    if (form != MOTION_MDD) {
        fwrite(position, sizeof *position, (size_t)vertices, out);
        return;
    }
    for (int i = 0; i < vertices; i++) {
        for (int k = 0; k < 3; k++) print_swapped_float(out, position[i][k]);
    }
}

bool motion_write_open(struct motion_writer *writer, const char *path, int frames, int vertices, struct error *error)
{
    const char *dot = strrchr(path, '.');
    const struct motion_span span = {.frames = frames, .vertices = vertices, .spacing = 1};
    *writer = (struct motion_writer){.form = dot && strcasecmp(dot, ".pc2") == 0 ? MOTION_PC2 : MOTION_NPY,
                                     .frames = frames,
                                     .vertices = vertices};
    if (!file_output_open(&writer->output, path, error)) return false;
    motion_print_start(writer->output.stream, writer->form, &span);
    return true;
}

bool motion_write_frame(struct motion_writer *writer, const float (*position)[3], struct error *error)
{
    motion_print_frame(writer->output.stream, writer->form, position, writer->vertices);
    if (ferror(writer->output.stream))
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
