in vec4 paint;
in vec3 side;
out vec4 pixel;

void main() {
    // light from the left, the front and above; wings are visible from both sides
    float light = dot(normalize(side), vec3(-0.35, -0.35, 0.87));
    float shade = 0.5 - 0.5 * light;
    pixel = vec4(mix(paint.rgb, vec3(0.11, 0.125, 0.15), 0.5 * shade) * paint.a, paint.a);
}
