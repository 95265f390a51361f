#version 330 core
// What fills the gaps between the discs: a strip as wide as the spacing along each intact bond between
// neighbours. A broken bond has none, so a crack opens as a gap in the body.

uniform vec2 picture;
uniform float guard;
uniform isamplerBuffer bonds;        // the two particles of each
uniform samplerBuffer particles;     // centre, half the spacing (pixels), place in the colour map 0..1
uniform sampler2D colours;
uniform bool coloured;               // by the map, or all in one colour
uniform vec3 plain;

out float along;                     // 0 at the first particle .. 1 at the second
out float across;                    // from the bond (pixels)
flat out float half_width;           // (pixels)
flat out vec3 first_colour, second_colour;

// Four vertices per bond: the corners -1..1.
vec2 corner() { return vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0; }

vec3 colour_of(float value) {
    if (!coloured) return plain;
    return texelFetch(colours, ivec2(int(clamp(value, 0.0, 1.0) * 255.0 + 0.5), 0), 0).rgb;
}

void main() {
    ivec2 ends = texelFetch(bonds, gl_VertexID >> 2).xy;
    vec2 corner = corner();
    vec4 a = texelFetch(particles, ends.x), b = texelFetch(particles, ends.y);
    vec2 line = b.xy - a.xy;
    vec2 normal = vec2(-line.y, line.x) / max(length(line), 1e-6);
    // As wide as it is long, or the corner between four stretched bonds would show the background.
    half_width = min(a.z, b.z);
    half_width = clamp(0.5 * length(line), half_width, 1.2 * half_width) + 0.25;
    along = 0.5 * corner.x + 0.5;
    across = corner.y * (half_width + 0.5);
    vec2 place = mix(a.xy, b.xy, along) + normal * across;
    gl_Position = vec4((place + guard) / (picture + 2.0 * guard) * 2.0 - 1.0, 0.0, 1.0);
    first_colour = colour_of(a.w);
    second_colour = colour_of(b.w);
}
