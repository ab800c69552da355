in vec3 at;
in vec4 color;
out vec4 paint;

void main() {
    paint = color;
    gl_Position = clip * vec4(at, 1.0);
}
