// Background, ground and shadows. Shadows are discs blended over the rest; they fade out smoothly.
in vec2 disc;
in vec4 tint;
uniform vec3 top, bottom; // background, sRGB
uniform vec4 place;       // lowest column and row of pixels, and 1 / number of them
uniform bool shadow;
#ifdef BACKED
uniform sampler2D behind; // a picture, its top row first
uniform vec2 fit;         // the stage's size, with the picture's as 1
const float STRENGTH = 0.5; // of the picture, for the character to stand out
#endif
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
        vec2 on_stage = (gl_FragCoord.xy - place.xy) * place.zw;
        vec3 background = mix(bottom, top, on_stage.y);
#ifdef BACKED
        vec2 from = (on_stage - 0.5) * fit;
        vec4 seen = texture(behind, vec2(0.5 + from.x, 0.5 - from.y));
        float within = float(max(abs(from.x), abs(from.y)) < 0.5);
        background = mix(background, seen.rgb, STRENGTH * seen.a * within);
#endif
        pixel = vec4(mix(background, tint.rgb, tint.a * inside * inside) + noise / 255.0, 1.0);
    }
}
