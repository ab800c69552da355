in vec4 paint;
in vec2 place;
flat in vec3 shape;
out vec4 pixel;

void main() {
    float beyond = max(max(-place.x, place.x - shape.y), 0.0);
    float cover = clamp(shape.x + 0.5 - length(vec2(beyond, place.y)), 0.0, 1.0);
    if (shape.z > 0.0 && mod(place.x, 2.0 * shape.z) > shape.z) cover = 0.0;
    float alpha = paint.a * cover;
    pixel = vec4(paint.rgb * alpha, alpha);
}
