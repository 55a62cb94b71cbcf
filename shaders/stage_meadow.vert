// Reeds: one instanced strip. Each bends joint by joint like a tail. Few are wider than two pixels, so both sides are lit here, as a round
// stem's.
layout(location = 0) in vec2 corner; // joints from the ground; across: -1 … 1
layout(location = 1) in vec4 stands; // place, height
layout(location = 2) in vec4 swings; // y, Re x, Im x, turn of the wind
layout(location = 3) in vec4 leans;  // radians pushed towards +x and +z; shade, width
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec2 bend;  // lag and gain, radians per joint
uniform float seam; // metres per pixel at 1 m from the eye; 0: hard edges
uniform vec3 key_from;
uniform vec3 earth;
out vec3 color;
out vec2 edge;  // pixels across: from the middle, and to the edge
out float thin; // coverage in the middle

const float JOINTS = 6.0;
const vec3 FOOT = vec3(0.055, 0.080, 0.026); // linear
const vec3 STEM = vec3(0.250, 0.330, 0.075);
const vec3 STRAW = vec3(0.760, 0.540, 0.190);

// Lit as characters (stage_mesh.frag), without the rim.
vec3 lit(vec3 coat, vec3 n, float open_sky)
{
    const vec3 KEY = vec3(1.0, 0.8796, 0.7157), SKY = vec3(0.2747, 0.3663, 0.5210);
    float key = max((dot(n, key_from) + 0.4) / 1.4, 0.0);
    float upward = 0.5 + 0.5 * n.y;
    vec3 around = mix(earth * (2.0 - open_sky), SKY, upward) * mix(open_sky, 1.0, 0.5 - 0.5 * upward);
    vec3 linear = coat * (KEY * key + around) * 0.82;
    return max(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 0.0);
}

void main()
{
    vec2 wind = vec2(cos(swings.w), sin(swings.w));
    vec2 lean = vec2(0.0);
    vec3 along = vec3(0.0, 1.0, 0.0);
    vec3 world = stands.xyz;
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
    // A thick foot, seeds near the tip, pointed.
    float head = smoothstep(0.62, 0.7, up) * (1.0 - smoothstep(0.85, 1.0, up));
    float half_width = leans.w * (mix(0.5, 0.16, up) + 0.45 * head * step(0.55, leans.z));
    half_width *= step(up, 0.99);
    // At least one pixel wide but fainter, plus half a pixel per side for the edge.
    float pixel = seam * (clip_from_world * vec4(world, 1.0)).w;
    float drawn = max(half_width, 0.5 * pixel);
    thin = seam > 0.0 ? pow(half_width / drawn, 0.75) : 1.0; // sRGB blending darkens, hence the exponent
    edge = seam > 0.0 ? vec2(corner.y * (drawn / pixel + 0.5), drawn / pixel + 0.5) : vec2(0.0, 1.0);
    world += side * (corner.y * (drawn + 0.5 * pixel));
    vec3 grown = mix(FOOT, mix(STEM, STRAW, 0.55 * leans.z), smoothstep(0.0, 0.6, up));
    grown *= mix(0.4, 1.0, smoothstep(0.0, 0.5, up)); // reeds shade each other at the foot
    vec3 coat = mix(grown, STRAW * mix(0.75, 1.1, leans.z), smoothstep(0.55, 1.0, up) * 0.7);
    color = lit(coat, normalize(side * (0.8 * corner.y) + toward), 0.25 + 0.75 * smoothstep(0.0, 0.8, up));
    gl_Position = clip_from_world * vec4(world, 1.0);
}
