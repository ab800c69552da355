// A horizontal picture.
in vec3 from;
in vec3 to;
out vec2 place;

void main() {
    place = corner() * 0.5 + 0.5;
    gl_Position = clip * vec4(mix(from.xy, to.xy, place), from.z, 1.0);
}
