/// Rigs as a USD scene in text: UsdSkel skeletons, blend shapes, a time sample a key. Metres, y up; time codes are the document's frames.
#include "export/usda.h"
#include "base/file.h"
#include "base/need.h"
#include "export/form.h"
#include <ctype.h>
#include <stdlib.h>
#include <string.h>

// --- text

/// Letters outside ASCII that USD's names may have (Unicode's XID_Start, and XID_Continue): the scripts in common use.
static const struct {
    uint32_t first, last;
    bool only_inside; ///< not as the first letter
} letters[] = {{0xC0, 0xD6, false},     {0xD8, 0xF6, false},      {0xF8, 0x2C1, false},    {0x300, 0x36F, true},
               {0x370, 0x373, false},   {0x388, 0x38A, false},    {0x38E, 0x3A1, false},   {0x3A3, 0x3F5, false},
               {0x3F7, 0x481, false},   {0x48A, 0x52F, false},    {0x531, 0x556, false},   {0x560, 0x588, false},
               {0x591, 0x5BD, true},    {0x5D0, 0x5EA, false},    {0x620, 0x64A, false},   {0x64B, 0x669, true},
               {0x66E, 0x66F, false},   {0x671, 0x6D3, false},    {0x6F0, 0x6F9, true},    {0x900, 0x903, true},
               {0x904, 0x939, false},   {0x93A, 0x94F, true},     {0x958, 0x961, false},   {0x966, 0x96F, true},
               {0x985, 0x98C, false},   {0x993, 0x9A8, false},    {0x9BE, 0x9C4, true},    {0xE01, 0xE30, false},
               {0xE31, 0xE3A, true},    {0xE40, 0xE46, false},    {0xE47, 0xE4E, true},    {0xE50, 0xE59, true},
               {0x10D0, 0x10FA, false}, {0x1100, 0x1248, false},  {0x1E00, 0x1F15, false}, {0x3005, 0x3007, false},
               {0x3041, 0x3096, false}, {0x3099, 0x309A, true},   {0x30A1, 0x30FA, false}, {0x30FC, 0x30FF, false},
               {0x3105, 0x312F, false}, {0x3400, 0x4DBF, false},  {0x4E00, 0xA48C, false}, {0xAC00, 0xD7A3, false},
               {0xF900, 0xFA6D, false}, {0xFF10, 0xFF19, true},   {0xFF21, 0xFF3A, false}, {0xFF41, 0xFF5A, false},
               {0xFF66, 0xFF9D, false}, {0x20000, 0x2A6DF, false}};

static bool is_letter(uint32_t c, bool is_first)
{
    if (c < 0x80) return isalpha((int)c) || (!is_first && isdigit((int)c));
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        if (c >= letters[i].first && c <= letters[i].last) return !(is_first && letters[i].only_inside);
    }
    return false;
}

struct names usda_names(void) { return (struct names){.between = "_", .most = 63}; } // as many as Blender keeps

const char *usda_name(struct names *names, const char *wanted, bool any_script)
{
    char *const identifier = need(6 * strlen(wanted) + 2, 1), *to = identifier;
    for (const char *from = wanted; *from;) {
        const char *letter = from;
        const uint32_t c = utf8_next(&from);
        const bool fits = c < 0x80 || any_script;
        if (letter == wanted && !(fits && is_letter(c, true))) *to++ = '_';
        if (fits && is_letter(c, false)) {
            to = mempcpy(to, letter, (size_t)(from - letter));
        } else if (c == '-' && (letter == wanted || letter[-1] == '.')) {
            to = stpcpy(to, "minus_");
        } else {
            *to++ = '_';
        }
    }
    strcpy(to, wanted[0] ? "" : "_");
    const char *name = names_add(names, identifier);
    free(identifier);
    return name;
}

void usda_string(FILE *out, const char *text)
{
    fputc('"', out);
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\') fputc('\\', out);
        fprintf(out, (unsigned char)*c < ' ' ? "\\x%02x" : "%c", (unsigned char)*c);
    }
    fputc('"', out);
}

void usda_begin(FILE *out, int indent, const char *type, const char *name, const char *title, const char *api)
{
    const bool is_titled = strcmp(name, title) != 0;
    fprintf(out, "%*sdef %s \"%s\"%s\n", indent, "", type, name, is_titled || api ? " (" : "");
    if (is_titled) {
        fprintf(out, "%*sdisplayName = ", indent + 4, "");
        usda_string(out, title);
        fputc('\n', out);
    }
    if (api) fprintf(out, "%*sprepend apiSchemas = [\"%s\"]\n", indent + 4, "", api);
    if (is_titled || api) fprintf(out, "%*s)\n", indent, "");
    fprintf(out, "%*s{\n", indent, "");
}

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
    const char *folder = path_name(range->sidecars.folder);
    snprintf(range->summary + used, FORMAT_SUMMARY - (size_t)used, ", %d texture%s in %.*s", range->sidecars.count,
             range->sidecars.count == 1 ? "" : "s", name_fit(folder, 40), folder);
}

bool usda_write(struct export_range *range, FILE *out, struct error *error)
{
    struct names names = usda_names();
    bool done = true;
    fprintf(out, "#usda 1.0\n(\n    defaultPrim = \"scene\"\n    metersPerUnit = 1\n    upAxis = \"Y\"\n");
    fprintf(out, "    startTimeCode = %.9g\n    endTimeCode = %.9g\n    timeCodesPerSecond = %.9g\n)\n",
            range_frame(range, 0), range_frame(range, range->key_count - 1), range->posing->document->fps);
    fputs("\ndef Xform \"scene\"\n{", out);
    for (int r = 0; done && r < range->rig_count; r++) {
        const char *wanted = form_name(range->posing->document->rigs[range->rigs[r]]);
        done = write_rig(range, range->rigs[r], usda_name(&names, wanted, false), out, error);
    }
    fputs("}\n", out);
    names_free(&names);
    summarise(range);
    return done;
}
