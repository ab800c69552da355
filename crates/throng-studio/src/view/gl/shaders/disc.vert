// A horizontal body: all points within a radius of a rectangle, or of a point for a disc. It has a rim and a notch.
in vec4 before;
in vec4 now;
in vec4 body;
in vec4 look;
in vec4 fill;
in vec4 rim;
uniform bool shadows;
uniform vec4 shade;
out vec2 place;
out vec4 inner;
out vec4 outer;
flat out vec4 shape;
flat out float edge;
flat out float soft;

const float TURN = 6.283185307;

void main() {
    vec3 at = mix(before.xyz, now.xyz, share);
    float turn = now.w - before.w;
    float heading = before.w + (turn - TURN * floor(turn / TURN + 0.5)) * share;
    float depth = (clip * vec4(at, 1.0)).w;
    float scale = focal / max(depth, 1e-3);
    float radius = max(body.x, look.y * unit / scale);
    float clearance = radius + min(body.y, body.z);
    inner = fill;
    outer = rim;
    edge = look.x * unit / scale;
    if (look.x < 0.0) {
        edge = clamp(-look.x * clearance, 0.6 / scale, 3.0 * unit / scale);
        // the rim of a small disc would hide its fill colour
        outer = mix(fill, rim, clamp(0.4 * (clearance * scale / unit - 1.2), 0.0, 1.0));
    }
    // items that draw only their shadow
    if (!shadows && look.w > 0.5) {
        gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
        return;
    }
    soft = 0.0;
    if (shadows) {
        // a body on the ground has no shadow
        if (at.z <= 0.0 && look.w < 0.5) {
            gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
            return;
        }
        // a shadow spreads and fades with altitude such that the blocked light stays constant
        soft = 0.6 * radius + 0.06 * at.z;
        float spread = radius / (radius + 0.03 * at.z);
        inner = outer = vec4(shade.rgb, shade.a * fill.a * spread);
        radius += 0.5 * soft;
        at = vec3(at.xy + vec2(0.12, -0.12) * at.z, 0.0);
    }
    shape = vec4(body.yz, radius, shadows || clearance * scale < 3.5 * unit ? 0.0 : look.z);
    vec2 margin = vec2(1.5 / scale);
    place = corner() * (body.yz + radius + margin);
    vec2 along = vec2(cos(heading), sin(heading));
    vec2 offset = along * place.x + vec2(-along.y, along.x) * place.y;
    gl_Position = clip * vec4(at.xy + offset, at.z, 1.0);
}
