// Nothing: what a dispatch costs that has no work (gelatin bench kernels).
layout(local_size_x = 64) in;

void main() {}
