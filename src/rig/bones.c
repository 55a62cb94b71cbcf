/// Finds the bones of a chain.
#include "rig/bones.h"

static bool fail_missing(const struct gltf *gltf, const char *name, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected a bone called \"%s\", got none", gltf->path, name);
}

bool chain_find(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones,
                struct error *error)
{
    const int first = gltf_find_node(gltf, from), last = gltf_find_node(gltf, to);
    if (first < 0) return fail_missing(gltf, from, error);
    if (last < 0) return fail_missing(gltf, to, error);
    bones->count = 1;
    for (int n = last; n != first; n = gltf->nodes[n].parent, bones->count++) {
        if (n < 0)
            return fail(error, ERROR_INPUT, "%s: expected \"%s\" below \"%s\", got it elsewhere", gltf->path, to,
                        from);
        if (bones->count == ANGLES_MAX_JOINTS)
            return fail(error, ERROR_INPUT, "%s: expected at most %d bones from \"%s\" to \"%s\", got more",
                        gltf->path, ANGLES_MAX_JOINTS, from, to);
    }
    for (int i = bones->count - 1, n = last; i >= 0; i--, n = gltf->nodes[n].parent) {
        bones->node[i] = n;
        if (!gltf->nodes[n].has_matrix) continue;
        return fail(error, ERROR_INPUT, "%s: expected a bone that can turn, got \"%s\", which has a matrix",
                    gltf->path, gltf->nodes[n].name);
    }
    return true;
}

int chain_end(const struct gltf *gltf, int from, struct error *error)
{
    int last = from;
    for (int count = 1; count <= ANGLES_MAX_JOINTS; count++) {
        const int child = gltf->nodes[last].child, other = child < 0 ? -1 : gltf->nodes[child].next;
        if (child < 0) return last;
        if (other >= 0) {
            fail(error, ERROR_INPUT,
                 "\"%s\" branches into \"%s\" and \"%s\": choose the bone where the chain is to begin or end",
                 gltf->nodes[last].name, gltf->nodes[child].name, gltf->nodes[other].name);
            return -1;
        }
        last = child;
    }
    fail(error, ERROR_INPUT, "below \"%s\" there are more than %d bones: choose the one where the chain is to end",
         gltf->nodes[from].name, ANGLES_MAX_JOINTS);
    return -1;
}
