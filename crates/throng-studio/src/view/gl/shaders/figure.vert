// A shape with a forward direction and moving parts.
in vec3 corner_at;
in vec3 normal;
in vec3 joint;
in vec4 before;
in vec4 now;
in vec4 body;
in vec4 look;
in vec4 fill;
in vec4 turn;
out vec4 paint;
out vec3 side;

void main() {
    vec4 at = mix(before, now, share);
    vec3 ahead = normalize(mix(turn.xyz, body.xyz, share) + vec3(1e-6, 0.0, 0.0));
    vec3 left = normalize(cross(look.xyz, ahead) + vec3(0.0, 1e-6, 0.0));
    vec3 up = cross(ahead, left);
    float depth = (clip * vec4(at.xyz, 1.0)).w;
    float scale = focal / max(depth, 1e-3);
    float radius = max(body.w, look.w * unit / scale);
    vec3 local = corner_at;
    vec3 out_of = normal;
    float beat = joint.x * sin(at.w) * sign(corner_at.y);
    float step_angle = joint.y * sin(at.w);
    vec2 c = vec2(cos(beat), cos(step_angle));
    vec2 s = vec2(sin(beat), sin(step_angle));
    local = vec3(local.x, c.x * local.y - s.x * local.z, s.x * local.y + c.x * local.z);
    local.z -= joint.z;
    local = vec3(c.y * local.x + s.y * local.z, local.y, c.y * local.z - s.y * local.x);
    local.z += joint.z;
    vec3 world = at.xyz + (ahead * local.x + left * local.y + up * local.z) * radius;
    side = ahead * out_of.x + left * out_of.y + up * out_of.z;
    paint = fill;
    gl_Position = clip * vec4(world, 1.0);
}
