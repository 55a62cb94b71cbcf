#version 330 core
// The character: complex normal coordinates, D = Re(sum of z N) (eq. 29, 30). Shaded as the animal is.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tangent;
layout(location = 3) in vec3 color;
#ifdef PICTURED
layout(location = 4) in vec2 uv;
uniform vec4 base; // the material's colour
out vec2 at;
out float opacity;
#endif
uniform mat4 clip_from_world;
uniform vec3 place; // from the model's space to the world's
uniform vec2 shade; // height of the ground, and how far above it its shade reaches
// For each coordinate and vertex: Re N, Im N and their derivatives along the tangents u and v, packed into 5 texels of a
// row that holds 128 vertices (see pack_row() in stage_morph.c). Coordinate k begins at row first_row[k].
uniform highp sampler2D coordinates;
uniform int count;
uniform int first_row[4];
uniform vec2 weight[4]; // z
uniform int map_row;    // of the coordinate whose phases are shown; -1: none
uniform vec3 map_axis;  // the direction of movement that is shown, divided by its largest amplitude
uniform float dark;     // luminance below which a colour stays on the map: that of eyes and a nose
out vec3 world;
out vec3 world_normal;
out vec3 fur;
out vec2 phase;
out float open_sky;

// The phase map's colours: see ui/theme.h.
const float LIGHTNESS = 0.70;
const float CHROMA = 0.10;
const vec2 SWING = vec2(0.09298, 0.19939);
const float SPREAD = 0.6;

void add_coordinate(int row, vec2 z, inout vec3 moved, inout vec3 u, inout vec3 v)
{
    ivec2 at = ivec2(5 * (gl_VertexID & 127), row + (gl_VertexID >> 7));
    vec4 a = texelFetch(coordinates, at, 0);
    vec4 b = texelFetch(coordinates, at + ivec2(1, 0), 0);
    vec4 c = texelFetch(coordinates, at + ivec2(2, 0), 0);
    vec4 d = texelFetch(coordinates, at + ivec2(3, 0), 0);
    vec4 e = texelFetch(coordinates, at + ivec2(4, 0), 0);
    moved += z.x * a.xyz - z.y * vec3(a.w, b.xy);
    u += z.x * vec3(b.zw, c.x) - z.y * c.yzw;
    v += z.x * d.xyz - z.y * vec3(d.w, e.xy);
}

vec3 linear_of_oklab(float lightness, vec2 ab)
{
    vec3 lms = vec3(lightness) + vec3(0.3963377774 * ab.x + 0.2158037573 * ab.y,
                                      -0.1055613458 * ab.x - 0.0638541728 * ab.y, -0.0894841775 * ab.x - 1.2914855480 * ab.y);
    lms = lms * lms * lms;
    return vec3(dot(lms, vec3(4.0767416621, -3.3077115913, 0.2309699292)),
                dot(lms, vec3(-1.2684380046, 2.6097574011, -0.3413193965)),
                dot(lms, vec3(-0.0041960863, -0.7034186147, 1.7076147010)));
}

// The movement along map_axis, as a share of the largest: phase and amplitude as an angle and a length.
vec2 mapped_movement()
{
    ivec2 at = ivec2(5 * (gl_VertexID & 127), map_row + (gl_VertexID >> 7));
    vec4 a = texelFetch(coordinates, at, 0);
    vec4 b = texelFetch(coordinates, at + ivec2(1, 0), 0);
    return vec2(dot(a.xyz, map_axis), dot(vec3(a.w, b.xy), map_axis));
}

vec3 phase_color(vec2 z)
{
    vec2 shown = pow(max(length(z), 1e-6), SPREAD - 1.0) * z;
    return linear_of_oklab(LIGHTNESS + dot(SWING, shown), CHROMA * vec2(-shown.y, shown.x));
}

// The face stays: without eyes nobody sees which way the animal looks.
vec3 mapped_color()
{
    float luminance = dot(color, vec3(0.2126, 0.7152, 0.0722));
    return mix(color, phase_color(phase), smoothstep(0.3 * dark, dark, luminance));
}

void main()
{
    vec3 moved = position;
    vec3 u = tangent;
    vec3 v = cross(normal, tangent);
    for (int k = 0; k < count; k++) add_coordinate(first_row[k], weight[k], moved, u, v);
    world = moved + place;
    // What the deformation makes of both tangents spans the surface; squeezed flat, there is no direction and no NaN.
    vec3 across = cross(u, v);
    world_normal = across / max(length(across), 1e-9);
    phase = map_row >= 0 ? mapped_movement() : vec2(0.0);
    fur = map_row >= 0 ? mapped_color() : color;
#ifdef PICTURED
    fur *= base.rgb;
    opacity = base.a;
    at = uv;
#endif
    open_sky = 0.45 + 0.55 * smoothstep(0.0, shade.y, world.y - shade.x);
    gl_Position = clip_from_world * vec4(world, 1.0);
}
