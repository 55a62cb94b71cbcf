/// Decompresses meshes with Draco's library. The only C++ file.
#include "model/draco.h"
#include <draco/compression/decode.h>
#include <new>

// A file of a hundred bytes may claim a mesh of gigabytes, and Draco believes it. The linker (-Wl,--wrap) sends its allocations here, and
// `left` limits their sum for one mesh.
static const size_t unlimited = SIZE_MAX;
static thread_local size_t left = unlimited;

static size_t taken(size_t size)
{
    if (size > left) throw std::bad_alloc();
    if (left != unlimited) left -= size;
    return size;
}

extern "C" {
void *__real__Znwm(size_t size);
void *__real__Znam(size_t size);
void *__wrap__Znwm(size_t size) { return __real__Znwm(taken(size)); } // operator new
void *__wrap__Znam(size_t size) { return __real__Znam(taken(size)); } // operator new[]
}

static std::unique_ptr<draco::Mesh> open_mesh(const void *data, size_t size, size_t room)
{
    std::unique_ptr<draco::Mesh> mesh;
    left = room;
    try {
        draco::DecoderBuffer buffer;
        buffer.Init(static_cast<const char *>(data), size);
        auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
        if (decoded.ok()) mesh = std::move(decoded).value();
    } catch (const std::exception &) {
        mesh = nullptr;
    }
    left = unlimited;
    return mesh;
}

static void copy_corners(const draco::Mesh &mesh, draco_part *part)
{
    for (size_t i = 0; i < part->count; i++) {
        const uint32_t corner = mesh.face(draco::FaceIndex(uint32_t(i / 3)))[i % 3].value();
        memcpy(part->values + i * part->stride, &corner, sizeof corner);
    }
}

template <typename T>
static bool convert(const draco::PointAttribute *from, draco_part *part)
{
    for (size_t i = 0; i < part->count; i++) {
        const auto value = from->mapped_index(draco::PointIndex(uint32_t(i)));
        void *to = part->values + i * part->stride;
        if (value.value() >= from->size() || !from->ConvertValue(value, int8_t(part->components), static_cast<T *>(to)))
            return false;
    }
    return true;
}

static bool copy_attribute(const draco::Mesh &mesh, draco_part *part)
{
    static bool (*const of_type[])(const draco::PointAttribute *, draco_part *) = {
        convert<int8_t>, convert<uint8_t>, convert<int16_t>, convert<uint16_t>, nullptr, convert<uint32_t>, convert<float>};
    const auto *from = mesh.GetAttributeByUniqueId(uint32_t(part->attribute));
    return from && from->num_components() == part->components && of_type[part->type - 5120](from, part);
}

bool draco_decode(const void *data, size_t size, size_t room, draco_part *parts, int part_count, draco_memory *memory,
                  void *user)
{
    const auto mesh = open_mesh(data, size, room);
    bool done = mesh != nullptr;
    for (draco_part *part = parts; done && part < parts + part_count; part++) {
        const bool corners = part->attribute < 0;
        part->count = corners ? 3 * size_t(mesh->num_faces()) : mesh->num_points();
        part->values = static_cast<unsigned char *>(memory(user, part->count, part->stride));
        done = part->values && (corners || copy_attribute(*mesh, part));
        if (done && corners) copy_corners(*mesh, part);
    }
    return done;
}
