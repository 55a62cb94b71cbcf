// The interface, in device pixels from the top left.

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel; // in the glyph atlas
layout(location = 2) in vec4 color;
layout(location = 3) in vec3 edge; // distance from a line's middle, half width + 1/2, distance from its ends + 1/2

uniform vec2 framebuffer; // device pixels
uniform vec2 atlas_size;  // texels

out vec2 at;
out vec4 tint;
out vec3 rim;

void main()
{
    at = texel / atlas_size;
    tint = color;
    rim = edge;
    gl_Position = vec4(position.x / framebuffer.x * 2.0 - 1.0, 1.0 - position.y / framebuffer.y * 2.0, 0.0, 1.0);
}
