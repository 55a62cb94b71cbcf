// One shader for everything: coverage is the line's (across and along) times the glyph's. Solids use a white texel; filled shapes have edge
// values of full coverage.

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
