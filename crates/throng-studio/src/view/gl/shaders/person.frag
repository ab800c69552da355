#ifdef FIGURE
in vec4 paint;
#else
flat in vec4 paint;
#endif
// The direction to the sun.
uniform vec3 sun;
in vec3 side;
in float height;
out vec4 pixel;

void main() {
    // the sun, the sky, and light from the ground
    vec3 normal = normalize(side);
    float lit = max(dot(normal, sun), 0.0);
    vec3 sky = mix(vec3(0.46, 0.45, 0.45), vec3(0.66, 0.69, 0.74), 0.5 + 0.5 * normal.z);
    // feet and the ground shade each other
    float open = mix(0.78, 1.0, smoothstep(0.0, 0.35, height));
    vec3 light = sky * open + vec3(0.44, 0.42, 0.38) * lit;
    pixel = vec4(paint.rgb * light, 1.0);
}
