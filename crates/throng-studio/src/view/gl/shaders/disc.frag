in vec2 place;
in vec4 inner;
in vec4 outer;
flat in vec4 shape;
flat in float edge;
flat in float soft;
uniform vec4 notch;
out vec4 pixel;

void main() {
    vec2 beyond = abs(place) - shape.xy;
    float away = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0);
    float fine = max(fwidth(away), 1e-6);
    vec4 color = mix(inner, outer, clamp((away - (shape.z - edge)) / fine + 0.5, 0.0, 1.0));
    float cover = clamp((shape.z - away) / fine + 0.5, 0.0, 1.0);
    if (soft > 0.0) cover = 1.0 - smoothstep(shape.z - soft, shape.z, away);
    if (shape.w > 0.0) {
        // the notch extends from 0.36 to 0.82 radii of the disc inscribed at the front end
        float clearance = shape.z + min(shape.x, shape.y);
        vec2 front = place - vec2(shape.x - min(shape.x, shape.y), 0.0);
        float far = distance(front, vec2(clamp(front.x, 0.36 * clearance, 0.82 * clearance), 0.0));
        float half_width = max(0.14 * clearance, 0.6 * fine);
        color.rgb = mix(color.rgb, notch.rgb, clamp((half_width - far) / fine + 0.5, 0.0, 1.0) * notch.a * shape.w);
    }
    float alpha = color.a * cover;
    pixel = vec4(color.rgb * alpha, alpha);
}
