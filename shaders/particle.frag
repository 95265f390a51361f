#version 330 core
// A disc with an analytic edge. The distance comes from the window position, not from the sprite, so that
// sprites and squares give the same bits.
flat in vec3 disc;         // centre, radius (pixels)
flat in vec3 colour;
flat in vec2 edge;         // how much it is darkened, 0..1; how far inwards (pixels)

out vec4 result;

void main() {
    float inside = disc.z - distance(gl_FragCoord.xy, disc.xy);
    float shade = edge.x * (1.0 - smoothstep(0.0, edge.y, inside - 0.5));
    result = vec4(colour * (1.0 - shade), clamp(inside + 0.5, 0.0, 1.0));
}
