#version 330 core
// An imported character: its vertices follow up to eight joints each by linear-blend skinning.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 color;
layout(location = 4) in uvec4 joints;
layout(location = 5) in uvec4 more_joints;
layout(location = 6) in vec4 weights;
layout(location = 7) in vec4 more_weights;
uniform mat4 clip_from_world;
uniform vec2 shade;  // heights: of the ground, and of the dusk above it
uniform vec4 base;   // the material's colour
uniform int first;   // matrix of the skin's first joint
uniform bool many;   // more than four joints a vertex
// Three texels a matrix, the rows of bind -> world; 64 matrices a row of the texture.
uniform sampler2D matrices;
out vec3 world;
out vec3 world_normal;
out vec3 fur;
out vec2 phase; // none
out float open_sky;
out vec2 at;
out float opacity;

void add_joint(uint joint, float weight, inout vec4 x, inout vec4 y, inout vec4 z)
{
    int matrix = first + int(joint);
    ivec2 texel = ivec2(3 * (matrix & 63), matrix >> 6);
    x += weight * texelFetch(matrices, texel, 0);
    y += weight * texelFetch(matrices, texel + ivec2(1, 0), 0);
    z += weight * texelFetch(matrices, texel + ivec2(2, 0), 0);
}

void main()
{
    vec4 x = vec4(0.0), y = vec4(0.0), z = vec4(0.0), bind = vec4(position, 1.0);
    for (int k = 0; k < 4; k++) add_joint(joints[k], weights[k], x, y, z);
    for (int k = 0; many && k < 4; k++) add_joint(more_joints[k], more_weights[k], x, y, z);
    world = vec3(dot(x, bind), dot(y, bind), dot(z, bind));
    // Normals go by the cofactors of the blended matrix, whatever its scale; a mirror turns them round.
    vec3 cx = cross(y.xyz, z.xyz), cy = cross(z.xyz, x.xyz), cz = cross(x.xyz, y.xyz);
    vec3 turned = vec3(dot(cx, normal), dot(cy, normal), dot(cz, normal)) * sign(dot(x.xyz, cx));
    world_normal = turned / max(length(turned), 1e-12);
    fur = base.rgb * color.rgb;
    opacity = base.a * color.a;
    phase = vec2(0.0);
    at = uv;
    open_sky = 0.45 + 0.55 * smoothstep(0.0, shade.y, world.y - shade.x);
    gl_Position = clip_from_world * vec4(world, 1.0);
}
