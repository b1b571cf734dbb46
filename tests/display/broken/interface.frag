#version 330 core
// Does not compile: what a reload must survive.
void main() { color = nonsense; }
