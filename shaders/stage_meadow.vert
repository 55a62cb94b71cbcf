#version 330 core
// Reeds: one strip, instanced. Each bends joint by joint as a tail does, and is lit as the round stem that it faces the eye with.
layout(location = 0) in vec2 corner; // joints from the ground, and across: -1 … 1
layout(location = 1) in vec4 stands; // place, height
layout(location = 2) in vec4 swings; // y, Re x, Im x, turn of the wind
layout(location = 3) in vec4 leans;  // radians pushed towards +x and +z; shade, width
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec2 bend;  // lag and gain, radians a joint
out vec3 world;
out vec3 world_normal;
out vec3 fur;
out vec2 phase; // none
out float open_sky;

const float JOINTS = 6.0;
const vec3 FOOT = vec3(0.055, 0.080, 0.026); // linear
const vec3 STEM = vec3(0.250, 0.330, 0.075);
const vec3 STRAW = vec3(0.760, 0.540, 0.190);

void main()
{
    vec2 wind = vec2(cos(swings.w), sin(swings.w));
    vec2 lean = vec2(0.0);
    vec3 along = vec3(0.0, 1.0, 0.0);
    world = stands.xyz;
    for (float joint = 0.0; joint < JOINTS; joint += 1.0) {
        if (joint >= corner.x) break;
        float lag = joint * bend.x;
        lean += wind * bend.y * (swings.x + cos(lag) * swings.y + sin(lag) * swings.z) + leans.xy / JOINTS;
        float angle = length(lean);
        vec2 flat_part = angle > 1e-5 ? lean * (sin(angle) / angle) : lean;
        along = vec3(flat_part.x, cos(angle), flat_part.y);
        world += along * (stands.w / JOINTS);
    }
    float up = corner.x / JOINTS;
    vec3 ray = world - eye;
    vec3 toward = normalize(-ray - along * dot(-ray, along));
    vec3 side = cross(along, toward);
    // Thick at the foot, a head of seeds near the tip, pointed.
    float head = smoothstep(0.62, 0.7, up) * (1.0 - smoothstep(0.85, 1.0, up));
    float half_width = leans.w * (mix(0.5, 0.16, up) + 0.45 * head * step(0.55, leans.z));
    world += side * (corner.y * half_width);
    world_normal = normalize(side * (0.8 * corner.y) + toward);
    vec3 grown = mix(FOOT, mix(STEM, STRAW, 0.55 * leans.z), smoothstep(0.0, 0.6, up));
    grown *= mix(0.4, 1.0, smoothstep(0.0, 0.5, up)); // the others keep the light off
    fur = mix(grown, STRAW * mix(0.75, 1.1, leans.z), smoothstep(0.55, 1.0, up) * 0.7);
    phase = vec2(0.0);
    open_sky = 0.25 + 0.75 * smoothstep(0.0, 0.8, up);
    gl_Position = clip_from_world * vec4(world, 1.0);
}
