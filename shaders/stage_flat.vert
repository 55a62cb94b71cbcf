// Background, ground and contact shadows: quads in clip space with coordinates across a disc.
layout(location = 0) in vec4 clip;
layout(location = 1) in vec2 local;
layout(location = 2) in vec4 color;
out vec2 disc;
out vec4 tint;

void main()
{
    gl_Position = clip;
    disc = local;
    tint = color;
}
