// The example in README.md: simulates one second of a scene and prints statistics.
#include <cstdio>

#include "gelatin/scene.h"
#include "gelatin/simulator.h"

int main(int argc, char** argv) {
    gelatin::Simulator simulator(gelatin::load_scene(argc > 1 ? argv[1] : "scenes/bounce.toml"));
    for (int f = 0; f < 240; ++f) simulator.advance_frame();
    simulator.begin_statistics();
    const gelatin::FrameStatistics now = simulator.take_statistics();
    std::printf("after %.2f s: kinetic energy %.1f J, %zu nodes on the floor\n", now.time, now.kinetic_energy,
                now.contacts);
}
