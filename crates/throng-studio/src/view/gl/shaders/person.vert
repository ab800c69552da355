// A body moved by the matrices of its joints, which are texels of two pictures: the poses before and now.
in vec3 at;
in vec3 normal;
#ifdef FIGURE
// Four joints, their weights, and the colour.
in vec4 bones;
in vec4 weights;
in vec4 dye;
#else
// Two joints, the weight of the first, and the region.
in vec4 bones;
#endif
// The numbers among the poses before and now (-1: none before), and the look.
in vec4 slots;
in vec4 fill;
uniform highp sampler2D poses_before;
uniform highp sampler2D poses_now;
// People in a row of the pictures.
uniform int in_row;
// Colours of the regions of each look, with what a region is: 0: not worn, 1: worn, 2: of the colour of the top.
uniform vec4 palette[LOOKS * REGIONS];
#ifdef FIGURE
out vec4 paint;
#else
flat out vec4 paint;
#endif
out vec3 side;
out float height;

mat3x4 matrix(highp sampler2D poses, float person, float joint) {
    int number = int(person);
    ivec2 place = ivec2((number % in_row) * JOINTS * 3 + int(joint) * 3, number / in_row);
    return mat3x4(
        texelFetch(poses, place, 0), texelFetch(poses, place + ivec2(1, 0), 0), texelFetch(poses, place + ivec2(2, 0), 0)
    );
}

mat3x4 skin(highp sampler2D poses, float person) {
    mat3x4 first = matrix(poses, person, bones.x);
#ifdef FIGURE
    first *= weights.x;
    for (int k = 1; k < 4; k++) {
        if (weights[k] > 0.0) first += matrix(poses, person, bones[k]) * weights[k];
    }
    return first;
#else
    if (bones.z >= 1.0) return first;
    return first * bones.z + matrix(poses, person, bones.y) * (1.0 - bones.z);
#endif
}

void main() {
    mat3x4 moved = skin(poses_now, slots.y);
    if (slots.x >= 0.0 && share < 1.0) moved = skin(poses_before, slots.x) * (1.0 - share) + moved * share;
    vec3 world = vec4(at, 1.0) * moved;
    side = vec4(normal, 0.0) * moved;
    height = world.z;
#ifdef FIGURE
    paint = dye;
    gl_Position = clip * vec4(world, 1.0);
#else
    vec4 entry = palette[int(slots.z) * REGIONS + int(bones.w)];
    paint = vec4(fill.a > 0.0 && entry.a > 1.5 ? fill.rgb : entry.rgb, 1.0);
    // what is not worn is beyond the view
    gl_Position = entry.a > 0.5 ? clip * vec4(world, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
