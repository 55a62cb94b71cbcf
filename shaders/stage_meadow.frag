#version 330 core
// A reed, as much of the pixel as it covers.
in vec3 color;
in vec2 edge;
in float thin;
out vec4 pixel;

void main()
{
    pixel = vec4(color, thin * clamp(edge.y - abs(edge.x), 0.0, 1.0));
}
