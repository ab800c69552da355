// From points relative to the world's origin to clip coordinates.
uniform mat4 clip;
// Size of the picture, pixels.
uniform vec2 size;
// Pixels per point of the screen.
uniform float unit;
// Pixels per metre at a distance of one metre. In a plan, pixels per metre.
uniform float focal;
// Distance of the near plane, metres. 0 in a plan.
uniform float near;
// Interpolation weight between the previous and the current state.
uniform float share;

vec2 corner() {
    return vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
}
