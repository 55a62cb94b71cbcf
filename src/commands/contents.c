/// Prints what a glTF character holds.
#include "commands/contents.h"
#include "base/error.h"
#include "rig/bones.h"
#include <stdio.h>

enum { DEEPEST_INDENTED = 64 };

/// A root and the nodes below it, each under its parent. From a depth on that no screen is wide enough for, a number says how deep.
static void print_tree(const struct gltf *gltf, int root)
{
    const struct gltf_node *nodes = gltf->nodes;
    for (int n = root, depth = 0; n >= 0;) {
        if (depth <= DEEPEST_INDENTED) {
            print_line(stdout, "%*s%s", 2 + 2 * depth, "", nodes[n].name);
        } else {
            print_line(stdout, "%*s(%d deep) %s", 2 + 2 * DEEPEST_INDENTED, "", depth, nodes[n].name);
        }
        if (nodes[n].child >= 0) {
            n = nodes[n].child;
            depth++;
            continue;
        }
        for (; n >= 0 && nodes[n].next < 0; depth--) n = nodes[n].parent;
        if (n >= 0) n = nodes[n].next;
    }
}

/// Whether a way down to a tip begins at a node and not further up.
static bool begins_chain(const struct gltf *gltf, int node)
{
    const int parent = gltf->nodes[node].parent;
    struct error branches;
    return chain_end(gltf, node, &branches) >= 0 && (parent < 0 || chain_end(gltf, parent, &branches) < 0);
}

static void print_chains(const struct gltf *gltf)
{
    bool any = false;
    for (int n = 0; n < gltf->node_count; n++) {
        struct chain_bones bones;
        struct error error;
        const int last = begins_chain(gltf, n) ? chain_end(gltf, n, &error) : -1;
        if (last < 0 || last == n) continue;
        if (!chain_find(gltf, gltf->nodes[n].name, gltf->nodes[last].name, &bones, &error)) continue;
        if (!any) puts("ways down to a tip, for --chain:");
        print_line(stdout, "  %s:%s (%d bones)", gltf->nodes[n].name, gltf->nodes[last].name, bones.count);
        any = true;
    }
}

void contents_print(const struct gltf *gltf)
{
    printf("clips:%s\n", gltf->clip_count > 0 ? "" : " none");
    for (int c = 0; c < gltf->clip_count; c++)
        print_line(stdout, "  %s (%.3g s)", gltf->clips[c].name, gltf->clips[c].duration);
    printf("bones and other nodes:\n");
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].parent < 0) print_tree(gltf, n);
    }
    print_chains(gltf);
    if (gltf->not_shown) print_line(stdout, "not shown: %s", gltf->not_shown);
}
