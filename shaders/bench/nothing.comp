// Does nothing: measures the cost of a dispatch without work (gelatin bench kernels).
layout(local_size_x = 64) in;

void main() {}
