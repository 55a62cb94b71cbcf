#version 330 core
// The animal: its tail follows the joints by linear-blend skinning, its body the parts that it has (LIMBED, or FACED with a face too).
#if defined(FACED)
#define LIMBED
#endif
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 mark; // as in model/coat.h
layout(location = 3) in float bend;
layout(location = 4) in vec3 limb; // two parts of the body, and the share of the second: as in model/limbs.h
uniform mat4 clip_from_world;
uniform vec3 eye;
uniform vec4 shape; // scale, joints, metres a joint, height of the ground
uniform float seam; // metres a pixel at a distance of 1 m in the pass that softens silhouettes, else 0
// Three rows of bind → world for each slot: slot 0 is the body's, slot n + 1 follows joint n; then come those of the body's parts.
layout(std140) uniform Joints { vec4 rows[3 * 263]; };
out vec3 world;
out vec3 world_normal;
out vec3 marking;
out vec4 place;   // in bind space, and how much of it is the tail's
out float open_sky;

#ifdef LIMBED
int row_of(float part)
{
    return part > 0.0 ? 3 * int(shape.y + part + 0.5) : 0;
}

void follow_parts(out vec4 x, out vec4 y, out vec4 z)
{
    int from = row_of(limb.x), to = row_of(limb.y);
    x = mix(rows[from], rows[to], limb.z);
    y = mix(rows[from + 1], rows[to + 1], limb.z);
    z = mix(rows[from + 2], rows[to + 2], limb.z);
}
#else
// Blends in what the joints do to a point: rows of bind → world, and how the weights' change along the tail moves it.
// Weights are the uniform cubic B-spline along the tail, four joints at a time: smooth, and exact where it is straight.
void follow_joints(vec4 bind, inout vec4 x, inout vec4 y, inout vec4 z, out vec3 stretch)
{
    float along = bind.z / shape.z - 0.5;
    float first = floor(along);
    float t = along - first;
    float s = 1.0 - t;
    vec4 weight = vec4(s * s * s, 4.0 - 3.0 * t * t * (2.0 - t), 4.0 - 3.0 * s * s * (2.0 - s), t * t * t) / 6.0;
    vec4 slope = vec4(-s * s, t * (3.0 * t - 4.0), s * (4.0 - 3.0 * s), t * t) * (0.5 / shape.z);
    vec4 bx = vec4(0.0), by = vec4(0.0), bz = vec4(0.0), dx = vec4(0.0), dy = vec4(0.0), dz = vec4(0.0);
    for (int k = 0; k < 4; k++) {
        int row = 3 * int(clamp(first + float(k), 0.0, shape.y));
        bx += weight[k] * rows[row];
        by += weight[k] * rows[row + 1];
        bz += weight[k] * rows[row + 2];
        dx += slope[k] * rows[row];
        dy += slope[k] * rows[row + 1];
        dz += slope[k] * rows[row + 2];
    }
    x = mix(x, bx, bend);
    y = mix(y, by, bend);
    z = mix(z, bz, bend);
    stretch = bend * vec3(dot(dx, bind), dot(dy, bind), dot(dz, bind));
}
#endif

void main()
{
    vec4 bind = vec4(position * shape.x, 1.0);
    vec4 x = rows[0], y = rows[1], z = rows[2];
    vec3 stretch = vec3(0.0);
#ifdef LIMBED
    follow_parts(x, y, z);
#else
    if (bend > 0.0) follow_joints(bind, x, y, z, stretch);
#endif
    world = vec3(dot(x, bind), dot(y, bind), dot(z, bind));
    // Normals go by the cofactors of the deformation's gradient, which counts how the weights change along the tail:
    // d world / d bind = blended matrix + (slopes · matrices · bind) ⊗ e_z.
    vec3 across = vec3(x.x, y.x, z.x);
    vec3 upward = vec3(x.y, y.y, z.y);
    vec3 lengthwise = vec3(x.z, y.z, z.z) + stretch;
    // Where a bend is so tight that it flattens the skin, there is no direction; it must not be NaN.
    vec3 cofactors = cross(upward, lengthwise) * normal.x + cross(lengthwise, across) * normal.y +
                     cross(across, upward) * normal.z;
    world_normal = cofactors / max(length(cofactors), 1e-9);
    marking = mark;
    place = vec4(position, bend);
    open_sky = 0.45 + 0.55 * smoothstep(0.0, 0.35 * shape.x, world.y - shape.w);
    // The seam is the same skin, 1.5 pixels larger (1 is too little where facets are large) and pushed back behind
    // the first pass: only what sticks out is seen.
    vec3 ray = world - eye;
    gl_Position = clip_from_world * vec4(world + seam * (1.5 * length(ray) * world_normal + 2.5 * ray), 1.0);
}
