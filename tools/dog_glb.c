/// dog_glb OUT.glb: makes the dog, with its skeleton and its clips, for assets/models/dog.glb.
#include "model/dog.h"
#include <stdio.h>

enum { COAT_TRIANGLES = 14200 };

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: dog_glb OUT.glb\n", stderr);
        return ERROR_USAGE;
    }
    struct dog_skeleton skeleton;
    struct dog_pieces pieces = {.count = 1, .pieces = {{.material = DOG_COAT, .joint = -1}}};
    struct error error = {0};
    dog_skeleton_make(&skeleton);
    dog_coat(COAT_TRIANGLES, &pieces.pieces[0].mesh);
    dog_face(&skeleton, &pieces);
    int vertices = 0, triangles = 0;
    bool failed = false;
    for (int p = 0; p < pieces.count; p++) {
        vertices += pieces.pieces[p].mesh.vertex_count;
        triangles += pieces.pieces[p].mesh.index_count / 3;
        failed = failed || pieces.pieces[p].mesh.failed;
    }
    if (failed) {
        fail_no_memory(&error, "the dog");
    } else if (dog_write(argv[1], &skeleton, &pieces, &error)) {
        printf("%s: %d joints, %d vertices, %d triangles\n", argv[1], skeleton.count, vertices, triangles);
    }
    for (int p = 0; p < pieces.count; p++) mesh_free(&pieces.pieces[p].mesh);
    if (error.kind != ERROR_NONE) fprintf(stderr, "dog_glb: %s\n", error.text);
    return (int)error.kind;
}
