// A reed, blended by its coverage of the pixel.
in vec3 color;
in vec2 edge;
in float thin;
out vec4 pixel;

void main()
{
    pixel = vec4(color, thin * clamp(edge.y - abs(edge.x), 0.0, 1.0));
}
