#version 330 core
// What a reload must show.
out vec4 color;
void main() { color = vec4(1.0); }
