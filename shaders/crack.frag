#version 330 core
flat in vec4 axis;         // middle and half the straight part of the capsule, as a vector (pixels)
flat in float half_width, halo;
flat in vec4 colour;

uniform vec3 background;

out vec4 result;

void main() {
    vec2 from_middle = gl_FragCoord.xy - axis.xy;
    float along = clamp(dot(from_middle, axis.zw) / max(dot(axis.zw, axis.zw), 1e-6), -1.0, 1.0);
    float off = distance(from_middle, along * axis.zw);
    float core = clamp(half_width - off + 0.5, 0.0, 1.0);
    float border = 0.6 * (1.0 - core) * clamp(half_width + halo - off + 0.5, 0.0, 1.0) * min(halo, 1.0);
    float cover = core + border;
    result = vec4((core * colour.rgb + border * background) / max(cover, 1e-4), cover * colour.a);
}
