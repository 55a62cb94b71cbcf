#version 330 core
// An imported character, and the skirts of that and of a soft one: they come as they stand (draw/skirt.h).
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec2 movement;
layout(location = 5) in float cover;
uniform mat4 clip_from_world;
uniform vec2 shade; // as in stage_character.vert
out vec3 world;
out vec3 world_normal;
out vec3 fur;
out vec2 phase;
out float open_sky;
out vec2 at;
out float opacity;
out float skirt;

void main()
{
    world = place;
    world_normal = normal;
    fur = color.rgb;
    opacity = color.a;
    phase = movement;
    at = uv;
    open_sky = 0.45 + 0.55 * smoothstep(0.0, shade.y, world.y - shade.x);
    skirt = cover;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
