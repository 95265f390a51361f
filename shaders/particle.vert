#version 330 core
// A particle: a point sprite, or a square where it is larger than sprites can be.

uniform vec2 picture;      // size (pixels)
uniform float guard;       // how far the viewport reaches beyond the picture (pixels)
uniform bool squares;      // two triangles per particle instead of a point sprite
uniform samplerBuffer particles;  // centre, half the spacing (pixels), place in the colour map 0..1
uniform sampler2D colours;
uniform bool coloured;     // by the map, or all in one colour
uniform vec3 plain;

flat out vec3 disc;        // centre, radius (pixels)
flat out vec3 colour;

// Two triangles per particle: the corners -1..1 of vertices 0..5.
vec2 corner() {
    int k = int[6](0, 1, 2, 2, 1, 3)[gl_VertexID % 6];
    return vec2(k & 1, k >> 1) * 2.0 - 1.0;
}

void main() {
    vec4 particle = texelFetch(particles, squares ? gl_VertexID / 6 : gl_VertexID);
    // Below a few pixels discs overlap, so that no gaps flicker through the body.
    float radius = particle.z * mix(1.45, 0.97, smoothstep(2.5, 6.0, 2.0 * particle.z));
    float reach = radius + 1.0;
    vec2 place = particle.xy + (squares ? reach * corner() : vec2(0.0));
    gl_Position = vec4((place + guard) / (picture + 2.0 * guard) * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = 2.0 * reach;
    disc = vec3(particle.xy, radius);
    ivec2 entry = ivec2(int(clamp(particle.w, 0.0, 1.0) * 255.0 + 0.5), 0);
    colour = coloured ? texelFetch(colours, entry, 0).rgb : plain;
}
