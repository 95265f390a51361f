#version 330 core
// A disc with an analytic edge. The distance comes from the window position, not from the sprite, so that
// sprites and squares give the same bits.
flat in vec3 disc;         // centre, radius (pixels)
flat in vec3 colour;

uniform float rim;         // how much the edge is darkened, 0..1
uniform float unit;        // pixels in this picture per pixel in one 1080 high

out vec4 result;

void main() {
    float inside = disc.z - distance(gl_FragCoord.xy, disc.xy);
    float width = min(max(1.5 * unit, 1.0), 0.4 * disc.z);
    float shade = rim * smoothstep(2.0, 3.5, disc.z) * (1.0 - smoothstep(0.0, width, inside - 0.5));
    result = vec4(colour * (1.0 - shade), clamp(inside + 0.5, 0.0, 1.0));
}
