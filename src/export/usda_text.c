/// Names and arrays of .usda files.
#include "export/usda_text.h"
#include <ctype.h>
#include <string.h>

void usda_identifier(const char *name, char identifier[FORM_NAME])
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

void usda_vectors(FILE *out, const char *declaration, const float (*vectors)[3], int count)
{
    fprintf(out, "            %s = [", declaration);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s(%.9g, %.9g, %.9g)", i > 0 ? ", " : "", (double)vectors[i][0], (double)vectors[i][1],
                (double)vectors[i][2]);
    }
    fputs("]", out);
}

void usda_by_vertex(FILE *out, int each)
{
    fputs(" (\n", out);
    if (each > 0) fprintf(out, "                elementSize = %d\n", each);
    fputs("                interpolation = \"vertex\"\n            )\n", out);
}

void usda_unique(char names[][FORM_NAME], int count, const char *wanted, char name[FORM_NAME])
{
    int number = 1;
    usda_identifier(wanted, name);
    for (int i = 0; i < count; i++) {
        if (strcmp(names[i], name) != 0) continue;
        char numbered[FORM_NAME + 16];
        snprintf(numbered, sizeof numbered, "%.40s_%d", wanted, ++number);
        usda_identifier(numbered, name);
        i = -1;
    }
}
