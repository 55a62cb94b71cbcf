#version 330 core
// Wrapped key light, hemisphere, rim. Colours are linear until the last line.
in vec3 world;
in vec3 world_normal;
in vec3 fur;
in float open_sky;
uniform vec3 eye;
uniform vec3 key_from;
out vec4 pixel;

const vec3 KEY = vec3(1.0, 0.8796, 0.7157);      // #FFF1DC
const vec3 SKY = vec3(0.2747, 0.3663, 0.5210);   // #8FA3BF
const vec3 EARTH = vec3(0.0232, 0.0176, 0.0144); // #2A2420
const vec3 RIM = vec3(0.3325, 0.5711, 1.0);      // #9CC7FF
const float EXPOSURE = 0.82;                     // the white tip, fully lit, just does not burn out

void main()
{
    vec3 n = normalize(world_normal);
    float facing = dot(n, normalize(eye - world));
    float key = max((dot(n, key_from) + 0.4) / 1.4, 0.0);
    float graze = 1.0 - clamp(facing, 0.0, 1.0);
    float upward = 0.5 + 0.5 * n.y;
    vec3 light = KEY * key + mix(EARTH, SKY, upward) * open_sky;
    // The rim is the sky's: what faces the ground has less of it.
    vec3 linear = fur * light * EXPOSURE + RIM * (0.35 * graze * graze * graze * open_sky * upward);
    // Across the silhouette of a round shape facing² grows linearly with the distance in pixels, so its slope tells
    // how far inside this pixel is: the opacity of the soft seam (second pass); the first pass does not blend.
    float square = facing * abs(facing);
    float inside = clamp(square / max(length(vec2(dFdx(square), dFdy(square))), 1e-4), 0.0, 1.0);
    pixel = vec4(max(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 0.0), inside);
}
