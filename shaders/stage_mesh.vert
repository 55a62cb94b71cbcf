#version 330 core
// The animal, whose skin comes as it stands (draw/stage_skin.h).
layout(location = 0) in vec3 position; // bind space, at the size that it is made in
layout(location = 1) in vec3 mark;     // as in model/mesh.h
layout(location = 2) in float bend;
layout(location = 3) in vec3 moved; // world
layout(location = 4) in vec3 moved_normal;
layout(location = 5) in float opaque; // of the skirt
layout(location = 6) in float open;   // as in model/mesh.h
uniform mat4 clip_from_world;
uniform vec2 shape; // scale, height of the ground
out vec3 world;
out vec3 world_normal;
out vec3 marking;
out vec4 place;   // in bind space, and how much of it is the tail's
out float open_sky;
out float skirt;
out float open_around;

void main()
{
    world = moved;
    world_normal = moved_normal;
    marking = mark;
    place = vec4(position, bend);
    open_sky = 0.45 + 0.55 * smoothstep(0.0, 0.35 * shape.x, world.y - shape.y);
    skirt = opaque;
    open_around = open;
    gl_Position = clip_from_world * vec4(world, 1.0);
}
