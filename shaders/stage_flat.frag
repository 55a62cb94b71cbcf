#version 330 core
// A disc that fades out smoothly, over what is there; the background's quad stays in the middle of its disc.
in vec2 disc;
in vec4 tint;
out vec4 pixel;

void main()
{
    float inside = max(1.0 - dot(disc, disc), 0.0);
    float opacity = tint.a * inside * inside;
    // Half a bit of noise (interleaved gradient noise) hides the steps of 8-bit gradients this dark; blending must not
    // weaken it.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    pixel = vec4(tint.rgb + noise / (255.0 * max(opacity, 0.3)), opacity);
}
