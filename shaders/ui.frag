#version 330 core
// One shader for all: coverage is that of a line (across and along) times the glyph's. Solids point at a white texel, and
// shapes that are no lines have an edge that covers everything.

uniform sampler2D glyphs;

in vec2 at;
in vec4 tint;
in vec3 rim;

out vec4 result;

void main()
{
    float coverage = clamp(rim.y - abs(rim.x), 0.0, 1.0) * clamp(rim.z, 0.0, 1.0) * texture(glyphs, at).r;
    result = vec4(tint.rgb, tint.a * coverage);
}
