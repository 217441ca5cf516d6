#include "model/scene/scene_file_copies.h"

#include <fmt/core.h>

#include <cstdint>
#include <random>

namespace gelatin {
namespace {

constexpr int kMost = 100'000;
constexpr Limit kCounts{"from 1 to 100000", [](double v) { return v >= 1.0 && v <= kMost; }};
constexpr Limit kTurn{"from 0 to 180", [](double v) { return v >= 0.0 && v <= 180.0; }};

struct Copies {
    glm::ivec3 counts{1};
    glm::dvec3 spacing{0.0};  // [m]
    double jitter = 0.0;      // each coordinate moves by up to this [m]
    double turn = 0.0;        // about each axis by up to this [degrees]

    std::int64_t total() const { return std::int64_t{counts.x} * counts.y * counts.z; }
};

Copies read_table(TableReader& reader) {
    Copies copies;
    reader.require({"counts", "spacing"});
    reader.read("counts", copies.counts);
    reader.check("counts", kCounts);
    reader.read("spacing", copies.spacing);
    reader.check("spacing", kNotNegative);
    reader.read("jitter", copies.jitter);
    reader.check("jitter", kNotNegative);
    reader.read("turn", copies.turn);
    reader.check("turn", kTurn);
    reader.finish();
    if (copies.counts.x > kMost / copies.counts.y || copies.total() > kMost)
        reader.fail("counts", fmt::format("must make at most {} copies, make {}", kMost, copies.total()));
    for (int axis = 0; axis < 3; ++axis) {
        if (copies.counts[axis] > 1 && copies.spacing[axis] == 0.0)
            reader.fail("spacing", fmt::format("must be greater than 0 along {}", "xyz"[axis]));
    }
    return copies;
}

// Uniform in [-1, 1). The standard's distributions differ from library to library, its engines do not.
class Jitter {
public:
    glm::dvec3 next() {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    }

private:
    double number() { return static_cast<double>(engine_()) * 0x1p-31 - 1.0; }

    std::mt19937 engine_;
};

}  // namespace

std::vector<ObjectDescription> read_copies(TableReader reader, const ObjectDescription& original) {
    const Copies copies = read_table(reader);
    const glm::dvec3 first = original.position - 0.5 * copies.spacing * glm::dvec3(copies.counts - 1);
    std::vector<ObjectDescription> objects;
    Jitter jitter;
    for (int y = 0; y < copies.counts.y; ++y) {
        for (int z = 0; z < copies.counts.z; ++z) {
            for (int x = 0; x < copies.counts.x; ++x) {
                ObjectDescription object = original;
                object.name = fmt::format("{} {}", original.name, objects.size() + 1);
                object.position =
                    first + copies.spacing * glm::dvec3(x, y, z) + copies.jitter * jitter.next();
                object.rotation += copies.turn * jitter.next();
                objects.push_back(std::move(object));
            }
        }
    }
    return objects;
}

}  // namespace gelatin
