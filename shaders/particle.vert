#version 330 core
// A particle: a point sprite, or a square where it is larger than sprites can be.

uniform vec2 picture;      // size (pixels)
uniform float guard;       // how far the viewport reaches beyond the picture (pixels)
uniform bool squares;      // four corners per particle instead of a point sprite
uniform samplerBuffer particles;  // centre, half the spacing (pixels), place in the colour map 0..1
uniform sampler2D colours;
uniform float rim;         // how much the edge is darkened, 0..1
uniform float unit;        // pixels in this picture per pixel in one 1080 high
uniform bool coloured;     // by the map, or all in one colour
uniform vec3 plain;

flat out vec3 disc;        // centre, radius (pixels)
flat out vec3 colour;
flat out vec2 edge;        // how much it is darkened, 0..1; how far inwards (pixels)

// Four vertices per particle: the corners -1..1.
vec2 corner() { return vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1) * 2.0 - 1.0; }

void main() {
    vec4 particle = texelFetch(particles, squares ? gl_VertexID >> 2 : gl_VertexID);
    // Below a few pixels discs overlap, so that no gaps flicker through the body.
    float radius = particle.z * mix(1.45, 0.97, smoothstep(2.5, 6.0, 2.0 * particle.z));
    float reach = radius + 1.0;
    vec2 place = particle.xy + (squares ? reach * corner() : vec2(0.0));
    gl_Position = vec4((place + guard) / (picture + 2.0 * guard) * 2.0 - 1.0, 0.0, 1.0);
    gl_PointSize = 2.0 * reach;
    disc = vec3(particle.xy, radius);
    edge = vec2(rim * smoothstep(2.0, 3.5, radius), min(max(1.5 * unit, 1.0), 0.4 * radius));
    ivec2 entry = ivec2(int(clamp(particle.w, 0.0, 1.0) * 255.0 + 0.5), 0);
    colour = coloured ? texelFetch(colours, entry, 0).rgb : plain;
}
