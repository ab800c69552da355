// A line between two points with round ends and constant width on the screen.
in vec3 from;
in vec3 to;
in vec4 color;
in vec2 stroke;
out vec4 paint;
out vec2 place;
flat out vec3 shape;

void main() {
    vec4 a = clip * vec4(from, 1.0);
    vec4 b = clip * vec4(to, 1.0);
    if (a.w < near && b.w < near) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
    if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
    vec2 begin = a.xy / a.w * size * 0.5;
    vec2 end = b.xy / b.w * size * 0.5;
    float way = distance(begin, end);
    vec2 along = way > 1e-4 ? (end - begin) / way : vec2(1.0, 0.0);
    // a line thinner than a pixel becomes more transparent instead
    float width = max(stroke.x * unit, 1.0);
    paint = vec4(color.rgb, color.a * min(stroke.x * unit, 1.0));
    float reach = 0.5 * width + 1.0;
    vec2 where = corner();
    place = vec2(where.x < 0.0 ? -reach : way + reach, where.y * reach);
    shape = vec3(0.5 * width, way, stroke.y * unit);
    vec2 at = begin + along * place.x + vec2(-along.y, along.x) * place.y;
    vec4 ending = where.x < 0.0 ? a : b;
    gl_Position = vec4(at / (size * 0.5), ending.z / ending.w, 1.0);
}
