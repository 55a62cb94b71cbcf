// Background, ground and shadows. Shadows are discs blended over the rest; they fade out smoothly.
in vec2 disc;
in vec4 tint;
uniform vec3 top, bottom; // background, sRGB
uniform vec2 rows;        // lowest row of pixels, and 1 / number of rows
uniform bool shadow;
out vec4 pixel;

void main()
{
    float inside = max(1.0 - dot(disc, disc), 0.0);
    // Interleaved gradient noise hides the steps of dark 8-bit gradients.
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    if (shadow) {
        float opacity = tint.a * inside * inside;
        // Some drivers blend bytes, where only noise in the opacity has an effect; its sign decorrelates it from the ground's.
        pixel = vec4(tint.rgb, opacity * (1.0 - 0.12 * noise));
    } else {
        vec3 background = mix(bottom, top, (gl_FragCoord.y - rows.x) * rows.y);
        pixel = vec4(mix(background, tint.rgb, tint.a * inside * inside) + noise / 255.0, 1.0);
    }
}
