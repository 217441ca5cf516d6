// Only the depth.
void main() {}
