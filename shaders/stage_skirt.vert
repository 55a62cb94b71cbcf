// Characters and their skirts, already posed (draw/posed.h). All programs use it without macros, so that Mesa compiles it once for several.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 movement;
layout(location = 5) in float cover;
uniform mat4 clip_from_world;
uniform vec2 shade; // heights: the ground's, and how far above it its shade reaches
out vec3 world;
out vec3 world_normal;
out vec4 tint;
out vec2 at;
out vec2 phase;
out float open_sky;
out float skirt;

void main()
{
    world = position;
    world_normal = normal;
    tint = color;
    at = uv;
    phase = movement;
    open_sky = 0.45 + 0.55 * smoothstep(0.0, shade.y, world.y - shade.x);
    skirt = cover;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
