#version 330 core
// Wrapped key light, hemisphere, rim. Colours are linear until the last line.
in vec3 world;
in vec3 world_normal;
in vec3 fur;
in vec2 phase; // of the phase map: movement as a share of the largest, at the angle by which it leads
in float open_sky;
uniform vec3 eye;
uniform vec3 key_from;
uniform vec3 earth; // the light that comes up from the ground
uniform float seam; // 0 in the first pass
uniform float line; // pixels: width of the phase map's lines; 0 where no phases are shown
#ifdef PICTURED // an imported character's
in vec2 at; // in the picture
in float opacity;
uniform sampler2D picture;
uniform float cutoff;   // opacity below which nothing is drawn
uniform bool both_sides;
#endif
out vec4 pixel;

const vec3 KEY = vec3(1.0, 0.8796, 0.7157);      // #FFF1DC
const vec3 SKY = vec3(0.2747, 0.3663, 0.5210);   // #8FA3BF
const vec3 RIM = vec3(0.3325, 0.5711, 1.0);      // #9CC7FF
const float EXPOSURE = 0.82;                     // the white tip, fully lit, just does not burn out

// Unit vector; 0, not NaN, where there is no direction.
vec3 direction(vec3 v)
{
    return v / max(length(v), 1e-12);
}

// How many pixels inside its silhouette a round shape's pixel is, at most 1: opacity of the soft seam (second pass;
// the first does not blend). Where the radius is R, `facing` f falls to 0 over R·f²/2. A triangle is a chord of that
// arc: f changes by `slope` a pixel of a chord that is foreshortened to `flat_facing`, so R = 1/(slope · flat_facing).
// Unlike fwidth(f²), this is exact for facets smaller than a pixel, as nothing but what is linear in them is
// differentiated.
float seam_opacity(vec3 to_eye)
{
    float facing = dot(world_normal, to_eye);
    float slope = length(vec2(dFdx(facing), dFdy(facing)));
    float flat_facing = abs(dot(direction(cross(dFdx(world), dFdy(world))), to_eye));
    return clamp(0.5 * facing * abs(facing) / max(slope * flat_facing, 1e-6), 0.0, 1.0);
}

// Dark lines on the phase map between each eighth of a turn and the next, so that phases are told apart without hue and in any
// light. What is in step has none across it. They fade where they would run together, and where next to nothing moves,
// as phases mean nothing there.
vec3 with_phase_lines(vec3 color)
{
    const float EIGHTH = 0.785398163;
    float amplitude = length(phase);
    vec2 dx = dFdx(phase);
    vec2 dy = dFdy(phase);
    // Radians a pixel; unlike fwidth of the angle, it has no jump where half a turn ahead becomes half a turn behind.
    float slope = length(vec2(phase.x * dx.y - phase.y * dx.x, phase.x * dy.y - phase.y * dy.x)) /
                  max(amplitude * amplitude, 1e-9);
    float turn = amplitude > 0.0 ? atan(phase.y, phase.x) / EIGHTH : 0.0;
    float pixels = EIGHTH / max(slope, 1e-6); // from one line to the next
    float covered = clamp(0.5 * line + 0.5 - abs(fract(turn) - 0.5) * pixels, 0.0, 1.0);
    covered *= smoothstep(3.0 * line, 8.0 * line, pixels) * smoothstep(0.05, 0.12, amplitude);
    return color * (1.0 - 0.8 * covered);
}

void main()
{
    vec3 n = direction(world_normal);
    vec4 surface = vec4(fur, 1.0);
#ifdef PICTURED
    surface = vec4(fur, opacity) * texture(picture, at);
    if (surface.a < cutoff) discard;
    if (both_sides && !gl_FrontFacing) n = -n;
#endif
    vec3 to_eye = normalize(eye - world);
    float facing = dot(n, to_eye);
    float key = max((dot(n, key_from) + 0.4) / 1.4, 0.0);
    float graze = 1.0 - clamp(facing, 0.0, 1.0);
    float upward = 0.5 + 0.5 * n.y;
    vec3 light = KEY * key + mix(earth, SKY, upward) * open_sky;
    // The rim is the sky's: what faces the ground has less of it.
    vec3 coat = line > 0.0 ? with_phase_lines(surface.rgb) : surface.rgb;
    vec3 linear = coat * light * EXPOSURE + RIM * (0.35 * graze * graze * graze * open_sky * upward);
    pixel = vec4(max(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 0.0), seam > 0.0 ? seam_opacity(to_eye) : surface.a);
}
