/// Rigs as a USD scene in text: UsdSkel skeletons, blend shapes, a time sample a key. Metres, y up; time codes are the document's frames.
#include "export/usda.h"
#include "base/file.h"
#include "base/need.h"
#include "export/form.h"
#include <ctype.h>
#include <search.h>
#include <stdlib.h>
#include <string.h>

// --- text

static void make_identifier(const char *name, char identifier[FORM_NAME])
{
    size_t used = 0;
    if (!isalpha((unsigned char)name[0])) identifier[used++] = '_';
    for (const char *c = name; *c && used + 6 < FORM_NAME; c++) {
        if (*c == '-') {
            memcpy(identifier + used, "minus_", 6);
            used += 6;
        } else {
            identifier[used++] = isascii((unsigned char)*c) && isalnum((unsigned char)*c) ? *c : '_';
        }
    }
    identifier[used] = '\0';
}

static int compare(const void *a, const void *b) { return strcmp(a, b); }

void usda_unique(struct usda_names *names, const char *wanted, char name[FORM_NAME])
{
    char numbered[FORM_NAME + 16];
    make_identifier(wanted, name);
    for (int number = names->count++;; number++) { // from where most likely none is
        char *const *found = tsearch(name, &names->tree, compare);
        if (!found) {
            need_failed();
        } else if (*found == name) {
            return;
        }
        snprintf(numbered, sizeof numbered, "%.40s_%d", wanted, number);
        make_identifier(numbered, name);
    }
}

static void keep(void *name) { (void)name; }

void usda_names_free(struct usda_names *names) { tdestroy(names->tree, keep); }

void usda_vector(FILE *out, const char *before, const float *v)
{
    fprintf(out, "%s(%.9g, %.9g, %.9g)", before, (double)v[0], (double)v[1], (double)v[2]);
}

void usda_matrix(FILE *out, const double m[16])
{
    for (int c = 0; c < 4; c++) {
        fprintf(out, "%s(%.17g, %.17g, %.17g, %.17g)", c > 0 ? ", " : "(", m[4 * c], m[4 * c + 1], m[4 * c + 2],
                m[4 * c + 3]);
    }
    fputs(")", out);
}

// --- rigs

/// Reads a rig back from the glTF file that it would be.
static bool read_own(struct export_range *range, int rig, struct gltf *gltf, struct error *error)
{
    char *data = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&data, &size);
    bool done = file && gltf_write_rig(range, rig, file, error);
    const bool whole = file && fclose(file) == 0;
    if (done && whole) return gltf_read_bytes(form_name(range->posing->document->rigs[rig]), data, size, gltf, error);
    free(data);
    return (file && !done) ? false : fail_no_memory(error, range->path);
}

static bool write_rig(struct export_range *range, int rig, const char *name, FILE *out, struct error *error)
{
    const struct rig *source = range->posing->document->rigs[rig];
    struct usda_model model = {.range = range, .rig = rig, .name = name, .out = out};
    struct rig_pose pose;
    struct gltf gltf = {0};
    model.is_own = !(form_kind(source->kind)->holds & FORM_FILE);
    if (!model.is_own && !range_pose(range, rig, 0, &pose, error)) return false;
    if (model.is_own && !read_own(range, rig, &gltf, error)) return false;
    model.gltf = model.is_own ? &gltf : &pose.model.imported->gltf;
    const bool done = usda_model_write(&model, error);
    gltf_free(&gltf);
    return done;
}

static void summarise(struct export_range *range)
{
    const int used = snprintf(range->summary, FORMAT_SUMMARY, "%d rig%s, %d keys", range->rig_count,
                              range->rig_count == 1 ? "" : "s", range->key_count);
    if (range->sidecars.count == 0) return;
    snprintf(range->summary + used, FORMAT_SUMMARY - (size_t)used, ", %d texture%s in %.40s", range->sidecars.count,
             range->sidecars.count == 1 ? "" : "s", path_name(range->sidecars.folder));
}

bool usda_write(struct export_range *range, FILE *out, struct error *error)
{
    struct usda_names names = {0};
    char(*name)[FORM_NAME] = need_zeroed((size_t)range->rig_count + 1, sizeof *name);
    bool done = true;
    fprintf(out, "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n");
    fprintf(out, "    startTimeCode = %.9g\n    endTimeCode = %.9g\n    timeCodesPerSecond = %.9g\n)\n",
            range_frame(range, 0), range_frame(range, range->key_count - 1), range->posing->document->fps);
    fputs("\ndef Xform \"scene\"\n{", out);
    for (int r = 0; done && r < range->rig_count; r++) {
        const char *wanted = form_name(range->posing->document->rigs[range->rigs[r]]);
        usda_unique(&names, wanted, name[r]);
        done = write_rig(range, range->rigs[r], name[r], out, error);
    }
    fputs("}\n", out);
    usda_names_free(&names);
    free(name);
    summarise(range);
    return done;
}
