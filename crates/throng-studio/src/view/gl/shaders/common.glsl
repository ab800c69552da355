// Points of the world, relative to its origin, to clip coordinates.
uniform mat4 clip;
// Size of the picture, pixels.
uniform vec2 size;
// Pixels of a point of the screen.
uniform float unit;
// Pixels of a metre that is a metre away; from straight above, of any metre.
uniform float focal;
// What is nearer to the eye than this is not seen, metres; from straight above 0.
uniform float near;
// How far the clock is from the state before to the state now.
uniform float share;

vec2 corner() {
    return vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
}
