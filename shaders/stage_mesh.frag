// Wrapped key light, hemisphere, rim. Colours are linear until the last line. FURRED is a fox's coat, FACED its head, PICTURED other meshes
// with pictures, masks or opacity.
#if defined(FACED)
#define FURRED
#endif
in vec3 world;
in vec3 world_normal;
in vec4 tint;  // colour and opacity; coat: position in bind space, and share of the tail
in vec2 at;    // texture coordinates; coat: depth inside white and dark markings, metres
in vec2 phase; // phase map: relative amplitude and lead as a complex number; coat: share of brown, and of ambient light
#ifdef FURRED
#ifdef FACED
uniform mat4 head_from_bind; // to the head's own space, which looks towards -z
uniform float blink;         // how far the lids are closed
#endif
const vec3 ORANGE = vec3(0.69387, 0.25415, 0.07036); // #D98A4B
const vec3 BROWN = vec3(0.19462, 0.05951, 0.02122);  // #7A4528
const vec3 WHITE = vec3(0.90466, 0.87962, 0.80695);  // #F4F1E8
const vec3 DARK = vec3(0.02416, 0.01229, 0.00913);   // #2B1D18
#else
uniform vec4 base; // the material's colour
#endif
in float open_sky;
#if defined(FURRED) || defined(PICTURED)
in float skirt; // coverage, below 1 only on skirts
#else
const float skirt = 1.0;
#endif
uniform vec3 eye;
uniform vec3 key_from;
uniform vec3 earth; // light reflected from the ground
#ifndef FURRED
uniform float line; // width of the phase map's lines, pixels; 0: no phases
#endif
#ifdef PICTURED
uniform sampler2D picture;
uniform float cutoff; // opacity below which nothing is drawn; 0: draw everything
uniform bool blended; // opacity is visible
uniform float seam;   // 0 in the first pass
uniform bool both_sides;
#endif
out vec4 pixel;

const vec3 KEY = vec3(1.0, 0.8796, 0.7157);      // #FFF1DC
const vec3 SKY = vec3(0.2747, 0.3663, 0.5210);   // #8FA3BF
const vec3 RIM = vec3(0.3050, 0.6105, 0.8714);   // #96CDF0: a bluer rim turns orange to lilac
const float EXPOSURE = 0.82;                     // keeps the fully lit white tip just below overexposure

// Unit vector; 0, not NaN, for a zero vector.
vec3 direction(vec3 v)
{
    return v / max(length(v), 1e-12);
}

#ifdef FURRED
const vec3 FUR_LIGHT = vec3(0.38, 0.20, 0.10); // light from nearby fur, relative to the light that it blocks
const float TUFT = 0.007; // depth of a marking's fringe, metres

// Coverage of a pixel whose centre is `depth` metres inside an edge, with `sharp` pixels per metre.
float covered(float depth, float sharp)
{
    return clamp(depth * sharp + 0.5, 0.0, 1.0);
}

// Coverage near a marking's edge, from the screen derivatives of `depth`: in tufts and at grazing angles it changes faster than the coat's
// position.
float marked(float depth)
{
    return clamp(depth / max(1.3 * length(vec2(dFdx(depth), dFdy(depth))), 0.004) + 0.5, 0.0, 1.0);
}

// About sin(2 pi x), at a quarter of its cost.
float wave(float x)
{
    float t = abs(fract(x - 0.25) * 4.0 - 2.0) - 1.0;
    return t * (1.5 - 0.5 * t * t);
}

// Strands of hair, -1 … 1: lengthwise on the tail, downwards elsewhere. They fade as pixels, `grain` metres wide, become coarser than
// strands.
float strands(float grain)
{
    vec3 q = tint.xyz * mix(vec3(30.0, 5.4, 30.0), vec3(17.5, 17.5, 3.2), tint.w);
    float woven = wave(q.x + 0.6 * q.y + 0.30 * wave(0.41 * q.z)) +
                  wave(q.z - 0.7 * q.y + 0.27 * wave(0.53 * q.x + 0.8 * q.y));
    return 0.5 * woven * clamp(1.6 - 100.0 * grain, 0.0, 1.0);
}

#ifdef FACED
// Eyes, nose and mouth, projected from the front, symmetrically. `gloss` is wetness.
vec3 with_face(vec3 coat, float sharp, out float gloss)
{
    vec3 in_head = (head_from_bind * vec4(tint.xyz, 1.0)).xyz;
    vec3 p = vec3(abs(in_head.x), in_head.yz);
    // A dark line from the eye towards the nose.
    vec2 from = p.xy - vec2(0.058, 0.004);
    float share = clamp(-25.0 * (from.x + from.y), 0.0, 1.0);
    float corner = 0.009 - 0.0072 * share - length(from + 0.02 * share);
    vec2 e = (p.xy - vec2(0.076, 0.016)) / vec2(0.0285, 0.0335);
    float ring = length(e);
    // The mouth: two arcs that meet below the nose, and a line up to it. They continue along the sides of the muzzle.
    float along = 0.4 * max(p.z + 0.255, 0.0);
    vec2 m = vec2(p.x + along, p.y) - vec2(0.022, -0.070);
    float mouth = 0.0032 - 0.06 * along - (m.y < 0.0 ? abs(length(m) - 0.027) : length(vec2(abs(m.x) - 0.027, m.y)));
    mouth = max(mouth, 0.0028 - max(p.x, abs(p.y + 0.072) - 0.012));
    vec3 n = (in_head - vec3(0.0, -0.047, -0.268)) / vec3(0.0250, 0.0200, 0.0240);
    float lines = covered(p.z < -0.14 ? max(corner, mouth) : corner, min(sharp, 330.0));
    float front = step(p.z, -0.045);
    float ball = front * covered((1.0 - ring) * 0.031, sharp), tip = covered((1.0 - length(n)) * 0.022, sharp);
    // An amber iris lit from below, around a pupil.
    float iris = 0.6 * clamp(0.55 - 0.6 * e.y, 0.0, 1.0) * clamp(4.5 * ring - 2.3, 0.0, 1.0) * clamp(5.0 - 5.0 * ring, 0.0, 1.0);
    vec3 drawn = mix(coat, DARK, 0.85 * front * lines);
    // The upper lid closes onto the lower one. Its lash line bends from arch to smile late: flat halfway down it would frown.
    float lid = mix(1.25, -0.55, blink) + (0.45 - 0.9 * blink * blink) * (1.0 - e.x * e.x) * 0.5 - e.y;
    float shut = covered(-0.0335 * lid, sharp) * step(0.01, blink);
    float lash = covered(0.0042 - 0.0335 * abs(lid), min(sharp, 330.0)) * step(0.01, blink);
    vec3 eyeball = mix(0.25 * DARK, vec3(0.42, 0.15, 0.03), iris), skin = mix(0.86, 0.97, -0.5 * lid) * coat;
    drawn = mix(drawn, mix(mix(eyeball, skin, shut), DARK, lash), ball);
    drawn = mix(drawn, 0.4 * DARK, tip);
    ball *= 1.0 - max(shut, lash);
    gloss = max(ball, tip);
    // Fixed reflections of the lamp, on the same side of both eyes.
    float side = in_head.x > 0.0 ? 0.009 : -0.009;
    float glint = covered(0.0092 - length(p.xy - vec2(0.077 - side, 0.029)), sharp);
    float second = covered(0.0036 - length(p.xy - vec2(0.084 - side, 0.006)), sharp);
    float wet = covered(0.0055 - length((in_head.xy - vec2(-0.005, -0.036)) * vec2(0.7, 1.4)), min(sharp, 250.0));
    return mix(drawn, vec3(1.3), max(ball * max(glint, 0.5 * second), 0.8 * tip * wet));
}
#endif

vec3 coat_here(out float gloss)
{
    float grain = 0.6 * length(fwidth(tint.xyz));
    float sharp = 1.0 / max(grain, 1e-5);
    float hair = strands(grain);
    vec3 coat = mix(ORANGE, BROWN, clamp(phase.x + 0.10 * hair * (0.4 + phase.x), 0.0, 1.0)) * (1.0 + 0.07 * hair);
    coat = mix(coat, WHITE * (1.0 + 0.05 * hair), marked(at.x + TUFT * hair));
    coat = mix(coat, DARK * (1.0 + 0.3 * hair), marked(at.y + TUFT * hair));
#ifdef FACED
    return with_face(coat, sharp, gloss);
#else
    gloss = 0.0;
    return coat;
#endif
}
#endif

#ifndef FURRED
#ifdef PICTURED
// Coverage by a mask. In the second pass it fades out within a pixel.
float mask(float a)
{
    float step = length(vec2(dFdx(a), dFdy(a)));
    if (cutoff <= 0.0 || a >= cutoff) return 1.0;
    float cover = seam > 0.0 ? clamp(1.0 - (cutoff - a) / max(step, 1e-5), 0.0, 1.0) : 0.0;
    return cover * cover;
}
#endif

// Dark lines on the phase map between eighths of a turn, so that phases differ without hue and in any light. They fade where lines would
// merge, and where amplitudes are too small for phases to matter.
vec3 with_phase_lines(vec3 color)
{
    const float EIGHTH = 0.785398163;
    float amplitude = length(phase);
    vec2 dx = dFdx(phase);
    vec2 dy = dFdy(phase);
    // Radians per pixel. Unlike fwidth of the angle, this has no jump at half a turn.
    float slope = length(vec2(phase.x * dx.y - phase.y * dx.x, phase.x * dy.y - phase.y * dy.x)) /
                  max(amplitude * amplitude, 1e-9);
    float turn = amplitude > 0.0 ? atan(phase.y, phase.x) / EIGHTH : 0.0;
    float pixels = EIGHTH / max(slope, 1e-6); // between lines
    float covered = clamp(0.5 * line + 0.5 - abs(fract(turn) - 0.5) * pixels, 0.0, 1.0);
    covered *= smoothstep(3.0 * line, 8.0 * line, pixels) * smoothstep(0.05, 0.12, amplitude);
    return color * (1.0 - 0.8 * covered);
}
#endif

// Error below half a step of 255, and cheaper than pow().
vec3 to_srgb(vec3 linear)
{
    vec3 a = sqrt(linear), b = sqrt(a), c = sqrt(b);
    return 0.662002687 * a + 0.684122060 * b - 0.323583601 * c - 0.0225411470 * linear;
}

void main()
{
    vec3 n = direction(world_normal);
    vec3 to_eye = normalize(eye - world);
#ifndef FURRED
    // Vertices without normals: the triangle is flat, and seen from its front.
    bool is_flat = world_normal == vec3(0.0);
    vec3 across = direction(cross(dFdx(world), dFdy(world)));
    if (is_flat) n = faceforward(across, -to_eye, across);
#endif
#ifdef FURRED
    float opacity_here = 1.0;
    float gloss;
    vec3 coat = coat_here(gloss);
#else
    vec4 surface = vec4(base.rgb * tint.rgb, 1.0);
#ifdef PICTURED
    surface = base * tint * texture(picture, at);
    float masked = mask(surface.a);
    if (masked <= 0.0) discard;
    if (!blended) surface.a = masked;
    if (both_sides && !gl_FrontFacing && !is_flat) n = -n;
#endif
    vec3 coat = line > 0.0 ? with_phase_lines(surface.rgb) : surface.rgb;
    float opacity_here = surface.a;
#endif
    float facing = dot(n, to_eye);
    float graze = clamp(1.0 - facing, 0.0, 0.9); // below 1, because a pixel at an edge shows more than the edge
    float graze2 = graze * graze;
    float key = max((dot(n, key_from) + 0.4) / 1.4, 0.0);
    float upward = 0.5 + 0.5 * n.y;
    // Light from the ground is warm, and strongest near it.
    vec3 around = mix(earth * (2.0 - open_sky), SKY, upward) * mix(open_sky, 1.0, 0.5 - 0.5 * upward);
    // A thin rim of sky light on surfaces that face up.
    float rim = 0.22 * graze2 * graze2 * graze2 * open_sky * upward;
#ifdef FURRED
    around *= mix(FUR_LIGHT, vec3(1.0), phase.y);
    key *= 0.5 + 0.5 * phase.y;
    rim *= phase.y * phase.y;
#endif
    vec3 light = KEY * key + around;
    vec3 linear = coat * light * EXPOSURE + RIM * rim;
#ifdef FURRED
    linear += (1.0 - gloss) * coat * light * (0.55 * graze2 * graze); // hair at the outline catches the light
#endif
    pixel = vec4(to_srgb(linear), skirt * skirt * opacity_here); // a skirt widens a shape by the mean of skirt², a third of a pixel
}
