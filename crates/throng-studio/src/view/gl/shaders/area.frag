in vec4 paint;
out vec4 pixel;

void main() {
    pixel = vec4(paint.rgb * paint.a, paint.a);
}
