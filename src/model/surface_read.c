/// Reads surfaces of any format.
#include "base/file.h"
#include "model/obj.h"
#include "model/surface_readers.h"

bool surface_read(const char *path, struct surface *surface, struct error *error)
{
    static const struct {
        const char *end;
        bool (*read)(const char *path, struct surface *surface, struct error *error);
    } formats[] = {{".stl", stl_read},
                   {".ply", ply_read},
                   {".off", off_read},
                   {".glb", gltf_surface_read},
                   {".gltf", gltf_surface_read}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        if (path_has_end(path, formats[i].end)) return formats[i].read(path, surface, error);
    }
    return obj_read(path, surface, error);
}
