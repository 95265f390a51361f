#version 330 core
// An intact bond: a thin line from centre to centre, over the particles.

uniform vec2 picture;
uniform float guard;
uniform float unit;                  // pixels in this picture per pixel in one 1080 high
uniform isamplerBuffer bonds;        // the two particles of each
uniform samplerBuffer particles;     // centre, half the spacing (pixels), place in the colour map 0..1

out float across;                    // from the bond (pixels)
flat out float half_width;           // (pixels)
flat out float strength;             // opacity

// Four vertices per bond: the corners -1..1.
vec2 corner() { return vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0; }

void main() {
    ivec2 ends = texelFetch(bonds, gl_VertexID >> 2).xy;
    vec2 corner = corner();
    vec4 a = texelFetch(particles, ends.x), b = texelFetch(particles, ends.y);
    vec2 line = b.xy - a.xy;
    vec2 normal = vec2(-line.y, line.x) / max(length(line), 1e-6);
    float spacing = a.z + b.z;
    float width = min(0.07 * spacing, 2.5 * unit);
    half_width = max(0.5 * width, 0.5);
    // A line thinner than a pixel is drawn one pixel wide and fainter; dense bodies show none.
    strength = 0.35 * min(width, 1.0) * smoothstep(12.0, 24.0, spacing);
    across = corner.y * (half_width + 0.5);
    vec2 place = mix(a.xy, b.xy, 0.5 * corner.x + 0.5) + normal * across;
    gl_Position = vec4((place + guard) / (picture + 2.0 * guard) * 2.0 - 1.0, 0.0, 1.0);
}
