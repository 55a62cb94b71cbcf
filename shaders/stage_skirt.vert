#version 330 core
// Characters, imported and soft, and their skirts: they come as they stand (draw/skirt.h).
// FURRED: in `color` come the place in bind space and how much of it is the tail's, in `uv` and `movement` markings (white, dark, brown) and
// the share of the light from all around.
#ifdef FACED
#define FURRED
#endif
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 movement;
layout(location = 5) in float cover;
uniform mat4 clip_from_world;
uniform vec2 shade; // heights: of the ground, and how far above it its shade reaches
#ifdef FURRED
out vec3 marking;
out vec4 place;
out float open_around;
#else
uniform vec4 base; // the material's colour
out vec3 fur;
out vec2 phase;
out vec2 at;
out float opacity;
#endif
out vec3 world;
out vec3 world_normal;
out float open_sky;
out float skirt;

void main()
{
    world = position;
    world_normal = normal;
#ifdef FURRED
    place = color;
    marking = vec3(uv, movement.x);
    open_around = movement.y;
#else
    fur = base.rgb * color.rgb;
    opacity = base.a * color.a;
    phase = movement;
    at = uv;
#endif
    open_sky = 0.45 + 0.55 * smoothstep(0.0, shade.y, world.y - shade.x);
    skirt = cover;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
