#version 330 core
in float along, across;
flat in float half_width;
flat in vec3 first_colour, second_colour;

uniform float gap;         // how much darker than the particles it joins, 0..1

out vec4 result;

void main() {
    float inside = half_width - abs(across);
    result = vec4(mix(first_colour, second_colour, along) * (1.0 - gap), clamp(inside + 0.5, 0.0, 1.0));
}
