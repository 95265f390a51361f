#version 330 core
in float across;
flat in float half_width, strength;

uniform vec3 colour;

out vec4 result;

void main() { result = vec4(colour, strength * clamp(half_width - abs(across) + 0.5, 0.0, 1.0)); }
