#include "gpu/support/pair_guard_scenarios.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "gpu/support/guard_runs.h"
#include "support/contact_scenes.h"
#include "support/random_maker.h"

namespace gelatin::test {
namespace {

// Where a node of an object is wanted that was somewhere.
using Move = std::function<glm::dvec3(std::uint32_t object, const glm::dvec3& x)>;

Wishes wish(const std::shared_ptr<const Model>& model, const Move& move, bool own = false) {
    Wishes wishes{.model = model, .own = own};
    const std::vector<std::uint32_t> object_of = model->node_objects;
    for (std::uint32_t n = 0; n < model->node_count(); ++n) {
        const glm::vec4& x = model->positions[n];
        wishes.ends.emplace_back(glm::vec3(move(object_of[n], glm::dvec3(x))), x.w);
    }
    return wishes;
}

Move by(const std::vector<glm::dvec3>& motions) {
    return [motions](std::uint32_t o, const glm::dvec3& x) {
        return x + (o < motions.size() ? motions[o] : glm::dvec3(0.0));
    };
}

// Two blocks of one cell, 0.1 m of size, side by side along x.
std::shared_ptr<const Model> blocks_beside(const std::vector<ColliderDescription>& colliders = {},
                                           double gap = 0.002,
                                           const glm::dvec3& second_size = glm::dvec3(0.1)) {
    return make_blocks({{.cells = {1, 1, 1}, .size = glm::dvec3(0.1)},
                        {.place = {0.1 + gap, 0, 0}, .cells = {1, 1, 1}, .size = second_size}},
                       {0, 0, 0}, colliders);
}

ColliderDescription a_surface(Shape shape, const glm::dvec3& position, bool moves = false) {
    ColliderDescription description;
    description.shape = std::move(shape);
    description.position = position;
    if (moves) {
        description.keyframes.resize(2);
        description.keyframes[1].time = 1.0;
        description.keyframes[1].move = {0.0, -1.0, 0.0};
    }
    return description;
}

ColliderDescription a_plane(const glm::dvec3& normal, double offset) {
    ColliderDescription description;
    description.shape = PlaneCollider{normal, offset};
    return description;
}

double largest_difference(const std::vector<glm::dvec4>& a, const std::vector<glm::dvec4>& b) {
    double largest = 0.0;
    for (std::size_t n = 0; n < a.size(); ++n) {
        const double distance = glm::distance(glm::dvec3(a[n]), glm::dvec3(b[n]));
        largest = distance <= largest ? largest : distance;  // what is not finite is large
    }
    return largest;
}

// How far nodes are held back, in the mean of squares [m].
double held_back(const Wishes& wishes, const std::vector<glm::dvec4>& ends) {
    double squares = 0.0;
    for (std::size_t n = 0; n < ends.size(); ++n) {
        const glm::dvec3 missing = glm::dvec3(wishes.ends[n]) - glm::dvec3(ends[n]);
        squares += glm::dot(missing, missing);
    }
    return std::sqrt(squares / static_cast<double>(ends.size()));
}

bool are_finite(const std::vector<glm::dvec4>& ends) {
    return std::all_of(ends.begin(), ends.end(), [](const glm::dvec4& x) {
        return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
    });
}

bool is_sound(const Wishes& wishes, const Guarded& guarded) {
    const Model& model = *wishes.model;
    if (!are_finite(guarded.ends) || guarded.is_given_up || touch_on_the_way(wishes, guarded.ends))
        return false;
    for (const Collider& plane : model.colliders)
        for (std::uint32_t n = 0; n < model.body_node_count(); ++n)
            if (glm::dot(glm::dvec3(plane.center), glm::dvec3(guarded.ends[n])) <
                static_cast<double>(plane.center.w))
                return false;
    return true;
}

double largest_difference(const Guarded& a, const Guarded& b) {
    return std::max(largest_difference(a.ends, b.ends), largest_difference(a.path_ends, b.path_ends));
}

// Where little room is left to a node that is wanted far away, it is shortened by much more than what
// rounding makes of its place. So in float the reference itself misses its ends in double.
// @param tolerance of ends, beside what the reference misses [m]
double parity_error(const Wishes& wishes, double tolerance) {
    const Guarded actual = guard_on_gpu(wishes), expected = guard_on_cpu<double>(wishes);
    if (actual.is_changed != expected.is_changed || actual.clipped != expected.clipped ||
        actual.runs != expected.runs || !is_sound(wishes, actual))
        return error_if(true);
    return largest_difference(actual, expected) /
           (tolerance + largest_difference(guard_on_cpu<float>(wishes), expected));
}

// Surfaces keep apart, and nodes go about as far as on the CPU. @param most times as much as there may be
// missing
double soundness_error(const Wishes& wishes, double most) {
    const Guarded actual = guard_on_gpu(wishes), expected = guard_on_cpu<double>(wishes);
    const double missing = held_back(wishes, actual.ends), there = held_back(wishes, expected.ends);
    if (expected.is_given_up)
        return error_if(!are_finite(actual.ends) || touch_on_the_way(wishes, actual.ends));
    if (!is_sound(wishes, actual) || !is_sound(wishes, expected)) return error_if(true);
    return missing / (most * there + 1e-6);
}

// What meets nothing ends where it is wanted.
double unchanged_error(const Wishes& wishes) {
    const Guarded actual = guard_on_gpu(wishes);
    const std::vector<glm::dvec4> wanted(wishes.ends.begin(), wishes.ends.end());
    return error_if(actual.is_changed || actual.clipped > 0 || actual.ends != wanted);
}

// Blocks and plates that fly at and deform as they like.
Wishes violent(unsigned seed) {
    RandomMaker random(seed);
    std::vector<Block> blocks = violent_blocks(random, 5);
    const auto model = make_blocks(blocks);
    const double step = 1.0 / 240.0, size = random.magnitude(1e-4, 0.1);
    std::vector<glm::dvec3> motions;
    for (const Block& block : blocks) motions.push_back(step * block.velocity);
    // Towards each other, so that they meet.
    for (std::size_t o = 1; o < motions.size(); ++o) motions[o].y -= random.uniform(0.1, 0.4) * double(o);
    return wish(
        model, [&](std::uint32_t o, const glm::dvec3& x) { return x + motions[o] + random.point(size); },
        random.integer(0, 1) == 1);
}

// A bar that is folded through itself.
Wishes folding(double angle) {
    const auto model = make_blocks({{.place = {-0.4, 0, 0}, .cells = {8, 1, 2}, .size = {0.8, 0.05, 0.2}}});
    return wish(
        model,
        [&](std::uint32_t, const glm::dvec3& x) {
            if (x.x <= 0.0) return x;
            const double c = std::cos(angle), s = std::sin(angle);
            return glm::dvec3(c * x.x - s * x.y, s * x.x + c * x.y, x.z);
        },
        true);
}

struct Push {
    glm::dvec3 motion, motion_of_other{0.0};
    double gap = 0.002, size = 0.1;  // before and of the other block [m]
    double room = -1.0;              // behind it; less than 0: no wall stands there [m]
};

// A handle, the right end of a block, pushes another block, which stands before a wall or does not.
double handle_error(const Push& push) {
    const double wall = 0.2 + push.gap + push.size + push.room;
    std::vector<ColliderDescription> walls;
    if (push.room >= 0.0) walls.push_back(a_surface(Shape(BoxShape{{0.2, 1.0, 1.0}}), {0.1 + wall, 0, 0}));
    const auto model = make_blocks(
        {{.cells = {2, 1, 1}, .size = {0.2, 0.1, 0.1}, .pins = {HalfSpaceRegion{{-1, 0, 0}, -0.05}}},
         {.place = {0.2 + push.gap, 0.01, 0}, .cells = {1, 1, 1}, .size = {push.size, 0.1, 0.1}}},
        {0, 0, 0}, walls);
    const Wishes wishes = wish(model, by({push.motion, push.motion_of_other}));
    const Guarded actual = guard_on_gpu(wishes), expected = guard_on_cpu<double>(wishes);
    if (!is_sound(wishes, actual)) return error_if(true);
    bool same = true;  // whether what is held goes where it goes on the CPU
    for (std::size_t n = 0; n < actual.ends.size(); ++n)
        same = same && (actual.ends[n].w != 0.0 || actual.ends[n] == expected.ends[n]);
    return std::max(error_if(!same),
                    held_back(wishes, actual.ends) / (1.1 * held_back(wishes, expected.ends) + 1e-6));
}

// Plates, each with one end above the middle of the one below; the first has it above a heavy block. All but
// the block go down. That stops the end of the first plate, so that this stops the end of the second one, and
// so on: one in each round.
struct Stairs {
    int plates;
    double tread = 0.2, gap = 0.002, fall = 0.04;  // [m]
};
Wishes make_stairs(const Stairs& stairs) {
    std::vector<Block> blocks{
        {.place = {-0.3, -0.3, -0.1}, .cells = {1, 1, 1}, .size = glm::dvec3(0.4, 0.3, 0.3)}};
    std::vector<glm::dvec3> motions{{0.5, 0, 0}};
    for (int k = 0; k < stairs.plates; ++k) {
        blocks.push_back({.place = {stairs.tread * k, stairs.gap + (0.002 + stairs.gap) * k, 0.01 * (k % 2)},
                          .cells = {1, 1, 1},
                          .size = {0.38, 0.002, 0.1}});
        motions.emplace_back(0.5, -stairs.fall, 0);
    }
    return wish(make_blocks(blocks), by(motions));
}

// A block, held above, between two walls that meet below it. Its other nodes are wanted behind both: what
// keeps one to a wall moves it into the other.
Wishes into_a_groove(bool of_planes) {
    const glm::dvec3 middle(0.05, -0.5, 0.05);
    std::vector<ColliderDescription> walls;
    for (const double side : {1.0, -1.0}) {
        const double angle = 0.05;
        const glm::dvec3 normal(side * std::cos(angle), std::sin(angle), 0.0),
            up(-side * std::sin(angle), std::cos(angle), 0.0);
        if (of_planes) {
            walls.push_back(a_plane(normal, glm::dot(normal, middle)));
        } else {
            walls.push_back(
                a_surface(Shape(BoxShape{{0.02, 1.0, 1.0}}), middle + 0.502 * up - 0.01 * normal));
            walls.back().rotation.z = side * glm::degrees(angle);
        }
    }
    const auto model = make_blocks({{.place = {0.035, 0, 0},
                                     .cells = {1, 1, 1},
                                     .size = {0.03, 0.1, 0.1},
                                     .pins = {HalfSpaceRegion{{0, -1, 0}, -0.05}}}},
                                   {0, 0, 0}, walls);
    return wish(model, [](std::uint32_t o, const glm::dvec3& x) {
        return o == 0 && x.y < 0.05 ? glm::dvec3(0.04 + 0.2 * x.x, -0.7, x.z) : x;
    });
}

// Above a groove of two planes, a block is held at its top; what is below is wanted in one plane, and what
// keeps it out of that pushes it into the other.
// @param up of its normals
Wishes into_a_wide_groove(double up) {
    std::vector<ColliderDescription> walls;
    for (const double side : {1.0, -1.0}) {
        const glm::dvec3 normal(side * std::sqrt(1.0 - up * up), up, 0.0);
        walls.push_back(a_plane(normal, glm::dot(normal, {0.05, -0.06 / up, 0.0})));
    }
    const auto model = make_blocks(
        {{.cells = {1, 1, 1}, .size = glm::dvec3(0.1), .pins = {HalfSpaceRegion{{0, -1, 0}, -0.05}}}},
        {0, 0, 0}, walls);
    return wish(model, [](std::uint32_t, const glm::dvec3& x) {
        return x.y < 0.05 ? x + glm::dvec3(0.3, -0.4, 0.0) : x;
    });
}

// A free one falls into it as a whole: no frame goes into it.
Wishes fall_into_a_groove() {
    const Wishes held = into_a_wide_groove(0.06);
    Model free = *held.model;
    for (glm::vec4& x : free.positions) x.w = 1.0f;
    return wish(std::make_shared<const Model>(std::move(free)), by({{0.01, -2.0, 0.0}}));
}

// A collider that comes down on a body on a box.
double press_error() {
    const auto model = make_blocks({{.cells = {2, 2, 2}, .size = glm::dvec3(0.2)}}, {0, 0, 0},
                                   {a_surface(Shape(BoxShape{glm::dvec3(0.5)}), {0.1, -0.252, 0.1}),
                                    a_surface(Shape(BoxShape{glm::dvec3(0.3)}), {0.1, 0.352, 0.1}, true)});
    const Wishes wishes = wish(model, by({{0, 0, 0}, {0, 0, 0}, {0, -0.3, 0}}));
    const Guarded actual = guard_on_gpu(wishes);
    if (!is_sound(wishes, actual) || actual.is_given_up) return error_if(true);
    const Range& nodes = model->objects[2].nodes;
    for (std::uint32_t n = nodes.first; n < nodes.end(); ++n)
        if (glm::vec3(actual.ends[n]) != glm::vec3(model->positions[n])) return error_if(true);
    return 0.0;
}

// Small bodies that fly to one point.
Wishes dozen() {
    std::vector<Block> blocks;
    for (int k = 0; k < 12; ++k)
        blocks.push_back({.place = 0.13 * glm::dvec3(k % 3, k / 6, k / 3 % 2),
                          .cells = {1, 1, 1},
                          .size = glm::dvec3(0.1)});
    RandomMaker random(7);
    std::vector<glm::dvec3> motions;
    for (const Block& block : blocks)
        motions.push_back(0.7 * (glm::dvec3(0.13, 0.06, 0.06) - block.place) + random.point(0.02));
    return wish(make_blocks(blocks), by(motions));
}

double infinite_error() {
    Wishes wishes = wish(blocks_beside(), by({{0.05, 0, 0}}));
    wishes.ends[3].y = std::numeric_limits<float>::quiet_NaN();
    wishes.ends[9].x = std::numeric_limits<float>::infinity();
    wishes.expected = wish(wishes.model, by({{0.05, 0, 0}})).ends;
    const Guarded actual = guard_on_gpu(wishes);
    return error_if(!is_sound(wishes, actual) || actual.clipped == 0);
}

double given_up_error() {
    Wishes wishes = wish(blocks_beside(), by({{0.001, 0, 0}}));
    wishes.loses_always = true;
    const Guarded actual = guard_on_gpu(wishes), expected = guard_on_cpu<double>(wishes);
    return error_if(!actual.is_given_up || !actual.is_changed || actual.runs != expected.runs ||
                    actual.ends != expected.ends);
}

// The try goes on where the guard is done, is made again in shorter parts where it finds no way, or waits for
// room.
double close_error() {
    Wishes wishes = wish(blocks_beside(), by({{0.05, 0, 0}}));
    const Guarded done = guard_on_gpu(wishes);
    if (done.clock.goes_on == 0 || done.clock.guards != 0) return error_if(true);
    wishes.is_long = wishes.loses_always = true;
    const Guarded halved = guard_on_gpu(wishes);
    if (halved.clock.goes_on != 0 || halved.is_given_up || halved.clock.step != 0.5f * halved.clock.size)
        return error_if(true);
    wishes.is_full = true;
    const Guarded full = guard_on_gpu(wishes);
    return error_if(full.clock.goes_on != 0 || full.clock.is_full == 0 || full.runs != 1 ||
                    full.clock.step != full.clock.size);
}

// Those beyond the end of the buffer are as if they were not there.
double full_guard_error() {
    Wishes wishes = wish(blocks_beside(), by({{0.05, 0, 0}}));
    wishes.capacity = 5;
    const Guarded actual = guard_on_gpu(wishes);
    return error_if(!are_finite(actual.ends) || actual.clipped == 0 || actual.clipped > 5);
}

}  // namespace

Scenarios pair_guard_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const std::string& name, std::function<double()> error) {
        scenarios.push_back({name, std::move(error)});
    };
    for (const double distance : {0.003, 0.05, 0.4})
        add("stops_after_" + std::to_string(int(1000 * distance)) + "_mm", [=] {
            return parity_error(wish(blocks_beside(), by({{distance, 0, 0}})), 1e-6);
        });
    add("both_sides_go", [] {
        return parity_error(wish(blocks_beside(), by({{0.05, 0, 0}, {-0.05, 0, 0}})), 1e-6);
    });
    add("shares_by_compliance", [] {
        Wishes wishes = wish(blocks_beside(), by({{0.05, 0, 0}, {-0.05, 0, 0}}));
        for (std::size_t n = 0; n < wishes.ends.size(); ++n)
            wishes.compliances.push_back(n < wishes.model->objects[0].nodes.count ? 99.0f : 1.0f);
        return parity_error(wishes, 1e-6);
    });
    add("a_frame_and_more", [] {
        const auto model = blocks_beside({}, 0.002, {0.2, 0.1, 0.15});
        return parity_error(wish(model, by({{0.45, 0.02, 0.1}, {0.4, 0, 0.1}})), 1e-6);
    });
    // A gap within rounding, which double has not: nothing may move there.
    add("without_a_gap", [] {
        return soundness_error(wish(blocks_beside({}, 1.5e-8), by({{0.02, 0, 0}, {-0.01, 0, 0}})), 1.6);
    });
    add("nothing_meets", [] {
        double error = 0.0;
        for (const glm::dvec3& motion :
             {glm::dvec3(0.0015, 0, 0), glm::dvec3(-0.2, 0, 0), glm::dvec3(0, 0.03, 0.02)})
            error += unchanged_error(wish(blocks_beside(), by({motion})));
        return error;
    });
    add("together", [] {
        return unchanged_error(wish(blocks_beside(), by({{0.5, 0.1, 0}, {0.5, 0.1, 0}})));
    });
    add("strays", [] {
        Wishes wishes = wish(blocks_beside(), by({}));
        wishes.expected = wishes.ends;
        for (std::size_t n = 0; n < wishes.ends.size(); ++n) {
            wishes.expected[n].x += 0.05f;
            wishes.ends[n].x += n == 3 ? 0.02f : n == 4 ? 0.0495f : 0.05f;
        }
        return parity_error(wishes, 1e-6);
    });
    add("into_planes", [] {
        const auto model = blocks_beside({a_plane({0, 1, 0}, -0.001), a_plane({-0.6, 0.8, 0}, -0.3)});
        return parity_error(wish(model, by({{0.3, -0.1, 0}, {-0.1, -0.3, 0.1}})), 2e-6);
    });
    add("into_a_groove_of_planes", [] { return parity_error(into_a_groove(true), 2e-6); });
    add("into_a_wide_groove", [] { return soundness_error(into_a_wide_groove(0.28), 1.1); });
    add("fall_into_a_groove", [] { return soundness_error(fall_into_a_groove(), 1.1); });
    add("into_a_groove", [] { return soundness_error(into_a_groove(false), 1.1); });
    add("pressed_on_a_plane", [] {
        const auto model =
            make_blocks({{.cells = {2, 1, 2}, .size = {0.2, 0.1, 0.2}},
                         {.place = {0.03, 0.102, 0.02}, .cells = {2, 1, 2}, .size = {0.2, 0.1, 0.2}}},
                        {0, 0, 0}, {a_plane({0, 1, 0}, -0.001)});
        return soundness_error(wish(model, by({{0.0, -0.01, 0}, {0.01, -0.2, 0}})), 1.1);
    });
    add("a_frame_into_a_plane", [] {
        const auto model = blocks_beside({a_plane({0, 1, 0}, -0.3)});
        return parity_error(wish(model, by({{0.45, -0.5, 0}, {0.4, -0.5, 0}})), 2e-6);
    });
    add("through_a_box", [] {
        const auto model = make_blocks({{.place = {0.05, 0.27, 0.1}}}, {0, 0, 0},
                                       {a_surface(Shape(BoxShape{glm::dvec3(0.5)}), {0, 0, 0})});
        return soundness_error(wish(model, by({{0.02, -1.0, 0.0}})), 1.1);
    });
    add("through_a_plate", [] {
        const auto model =
            make_blocks({{.place = {0.15, 0.03, 0.19}, .cells = {2, 4, 1}, .size = {0.1, 0.2, 0.02}},
                         {.cells = {4, 1, 4}, .size = {0.4, 0.02, 0.4}}});
        return soundness_error(wish(model, by({{0.0, -0.5, 0.01}, {0.0, 0.1, 0.0}})), 1.1);
    });
    for (const double angle : {0.5, 2.0, 3.6})
        add("folded_by_" + std::to_string(int(10 * angle)),
            [=] { return soundness_error(folding(angle), 1.1); });
    add("a_handle_with_room", [] { return handle_error({.motion = {0.05, 0, 0}}); });
    // With the wall, which is held too and does not move, nothing is in common.
    add("a_handle_with_room_at_a_wall", [] {
        return handle_error({.motion = {0.004, 0, 0}, .room = 0.006});
    });
    add("a_blocked_handle", [] { return handle_error({.motion = {0.2, 0, 0}, .room = 0.008}); });
    // To a plate that cannot give way, nearer than the least gap, but not too near.
    add("a_handle_that_just_fits", [] {
        return handle_error({.motion = {0.00195, 0, 0}, .size = 1e-4, .room = 2e-5});
    });
    // Within the slack of its path; what comes towards it then meets it where it stays.
    add("a_blocked_handle_on_its_path", [] {
        return handle_error({.motion = {0.0015, 0, 0},
                             .motion_of_other = {-0.0015, 0, 0},
                             .gap = 0.001,
                             .size = 1e-4,
                             .room = 2e-5});
    });
    add("stairs", [] { return parity_error(make_stairs({4}), 1e-6); });
    // More than there are rounds: all of it goes with what it has in common.
    add("long_stairs", [] { return soundness_error(make_stairs({12}), 2.0); });
    // So low that none leaves its path.
    add("a_low_pile", [] { return soundness_error(make_stairs({12, 0.0, 1e-4, 0.002}), 2.0); });
    add("a_press", [] { return press_error(); });
    add("a_dozen", [] { return soundness_error(dozen(), 1.1); });
    for (unsigned seed = 1; seed <= 12; ++seed)
        add("violent_" + std::to_string(seed), [=] { return soundness_error(violent(seed), 1.3); });
    add("what_is_not_finite_stays", [] { return infinite_error(); });
    add("runs_too_often", [] { return given_up_error(); });
    add("goes_on_or_not", [] { return close_error(); });
    add("too_many_pairs", [] { return full_guard_error(); });
    add("repeats", [] {
        const Wishes wishes = violent(3);
        const Guarded first = guard_on_gpu(wishes), second = guard_on_gpu(wishes);
        return error_if(first.ends != second.ends || first.path_ends != second.path_ends ||
                        first.clipped == 0);
    });
    return scenarios;
}

void run_pair_guard() {
    guard_on_gpu(wish(blocks_beside(), by({{0.05, 0, 0}})));
}

}  // namespace gelatin::test
