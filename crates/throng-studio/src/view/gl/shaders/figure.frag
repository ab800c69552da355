in vec4 paint;
// The direction to the sun.
uniform vec3 sun;
in vec3 side;
out vec4 pixel;

void main() {
    // the light of the sun and of the sky; wings are visible from both sides
    float light = dot(normalize(side), normalize(sun + vec3(0.0, 0.0, 0.6)));
    float shade = 0.5 - 0.5 * light;
    pixel = vec4(mix(paint.rgb, vec3(0.11, 0.125, 0.15), 0.5 * shade) * paint.a, paint.a);
}
