#version 330 core
// A broken bond: a capsule across the bond at its middle, where the crack face is.

uniform vec2 picture;
uniform float guard;
uniform float unit;                  // pixels in this picture per pixel in one 1080 high
uniform isamplerBuffer bonds;        // the two particles of each
uniform samplerBuffer states;        // freshness 1..0, rest length (pixels), place in the map
uniform samplerBuffer particles;     // centre, half the spacing (pixels), place in the colour map 0..1
uniform sampler2D colours;
uniform bool by_time;                // coloured by the map, or by freshness
uniform vec3 fresh_colour, old_colour;

flat out vec4 axis;                  // middle and half the straight part of the capsule, as a vector (pixels)
flat out float half_width;           // (pixels)
flat out float halo;                 // width of the border in the background's colour (pixels)
flat out vec4 colour;

// Four vertices per bond: the corners -1..1.
vec2 corner() { return vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0; }

void main() {
    ivec2 ends = texelFetch(bonds, gl_VertexID >> 2).xy;
    vec4 state = texelFetch(states, gl_VertexID >> 2);
    vec4 a = texelFetch(particles, ends.x), b = texelFetch(particles, ends.y);
    vec2 bond = b.xy - a.xy;
    float spacing = a.z + b.z, stretched = length(bond);
    vec2 along = vec2(-bond.y, bond.x) / max(stretched, 1e-6), normal = vec2(along.y, -along.x);
    // Longer bonds cross the same face beside its middle: the longer, the slighter their mark.
    float reached = state.y / spacing;
    float rank = 1.0 - 0.6 * smoothstep(1.1, 1.4, reached) - 0.2 * smoothstep(1.5, 1.9, reached);
    rank = mix(rank, max(rank, 0.6), state.x);  // but a fresh break is news, whatever its length
    float width = clamp(0.16 * spacing, max(1.4 * unit, 1.0), max(5.0 * unit, 1.4));
    width *= rank * (by_time ? 1.8 : 1.0 + 0.5 * state.x);
    half_width = 0.5 * max(width, 1.0);
    halo = min(1.2 * unit, 0.06 * spacing);
    float half_length = max(0.5 * spacing * rank - half_width, 0.0);
    // Faces that have parted keep no mark between them: it would float in empty space.
    float opening = max(stretched - state.y, 0.0) / spacing;
    float strength = min(width, 1.0) * rank * (1.0 - smoothstep(0.25, 1.5, opening));

    float reach = half_width + halo + 1.0;
    vec2 corner = corner();
    vec2 middle = 0.5 * (a.xy + b.xy);
    vec2 place = middle + along * corner.x * (half_length + reach) + normal * corner.y * reach;
    gl_Position = vec4((place + guard) / (picture + 2.0 * guard) * 2.0 - 1.0, 0.0, 1.0);
    axis = vec4(middle, along * half_length);
    ivec2 entry = ivec2(int(clamp(state.z, 0.0, 1.0) * 255.0 + 0.5), 0);
    colour = vec4(by_time ? texelFetch(colours, entry, 0).rgb : mix(old_colour, fresh_colour, state.x), strength);
}
