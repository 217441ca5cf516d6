#include "gpu/support/part_start_scenarios.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gpu/implicit/part_start.h"
#include "gpu/support/part_start_reference.h"
#include "model/assembly/build_model.h"
#include "model/contact/contact_surface.h"
#include "support/contact_scenes.h"
#include "support/elastic_cases.h"
#include "support/test_models.h"

namespace gelatin::test {
namespace {

using cpu::ContactRow;
using Field = std::vector<glm::dvec3>;

template <class T>
std::vector<T> download(const gl::Buffer<T>& buffer) {
    std::vector<T> values(buffer.size());
    gl::barrier(gl::Barrier::buffer_update);
    buffer.download(values);
    return values;
}

Field xyz_of(const gl::Buffer<glm::vec4>& buffer) {
    Field result;
    for (const glm::vec4& value : download(buffer)) result.emplace_back(value);
    return result;
}

std::vector<double> w_of(const gl::Buffer<glm::vec4>& buffer) {
    std::vector<double> result;
    for (const glm::vec4& value : download(buffer)) result.push_back(static_cast<double>(value.w));
    return result;
}

ContactRow<double> converted_row(const StepRow& row) {
    ContactRow<double> result;
    result.nodes[0] = row.node_0;
    result.other = row.other;
    result.normal = glm::dvec3(row.normal);
    result.gap = static_cast<double>(row.normal.w);
    result.ease = static_cast<double>(row.ease);
    result.reach = static_cast<double>(row.reach);
    result.stiffness = static_cast<double>(row.stiffness);
    result.damping = static_cast<double>(row.damping);
    result.friction = static_cast<double>(row.friction);
    result.hold = glm::dvec3(row.hold);
    result.limit = static_cast<double>(row.hold.w);
    result.key = key_of_contact(row.plane, row.node_0);
    return result;
}

// On the device: tries until one goes on, or many were made.
class OnGpu {
public:
    OnGpu(const StartCase& at, const StartInputs& inputs)
        : case_(at),
          model_(*at.model),
          buffers_(model_),
          surface_(make_contact_surface(model_, {})),
          state_(model_, surface_),
          system_(model_, capacity()),
          start_(model_, state_, system_) {
        if (!model_.loads.empty()) loads_.emplace(model_).run(state_.from);
        buffers_.pulls.set_pulls(inputs.pulls);
        system_.iterations = kStartIterations;
        std::vector<glm::vec4> accelerations;
        for (std::uint32_t n = 0; n < model_.node_count() && at.last_step > 0.0f; ++n)
            accelerations.push_back((model_.velocities[n] - inputs.earlier_velocities[n]) / at.last_step);
        state_.accelerations.values.upload(accelerations);
        if (!inputs.memories.empty()) state_.plane_memories.upload(inputs.memories);
        std::vector<BodyPace> paces(model_.objects.size());
        for (std::size_t o = 0; o < model_.body_count(); ++o) {
            paces[o].pace = at.paces[o];
            paces[o].is_struck = at.struck[o];
        }
        state_.paces.values.upload(paces);
        StepClock clock{};
        clock.last_step = at.last_step;
        clock.parts = 1;
        state_.clock.upload(std::vector{clock});
        // What is left of a solve before.
        system_.loads().upload(
            std::vector<glm::vec4>(model_.node_count(), glm::vec4(1.0f, 2.0f, 3.0f, 1e3f)));
        start_.begin_step(static_cast<double>(at.size), at.divides);
        clock = read_clock();
        clock.damps = at.damps ? 1 : 0;
        if (at.left > 0.0f) {
            clock.left = at.left;
            clock.longest = 0.6f * at.left;
            clock.made = clock.begun = 1;
        }
        state_.clock.upload(std::vector{clock});
    }

    StepClock read_clock() const { return download(state_.clock)[0]; }
    gpu::StepState& state() { return state_; }

    /// @return whether what is given up has left all as it was
    bool run() {
        bool is_untouched = true;
        for (int k = 0; k < 12; ++k) {
            start_.run(buffers_, loads_ ? &*loads_ : nullptr);
            if (read_clock().goes_on != 0) return is_untouched;
            const Field before = xyz_of(system_.displacements());
            system_.solve(state_.from);
            is_untouched = is_untouched && xyz_of(system_.displacements()) == before;
        }
        return false;
    }

    StartResult result() {
        StartResult result;
        result.clock = read_clock();
        result.paces = download(state_.paces.values);
        result.paces.resize(model_.body_count());
        std::vector<StepRow> rows = download(system_.buffers().rows.values);
        rows.resize(result.clock.row_count);
        for (const StepRow& row : rows) result.rows.push_back(converted_row(row));
        result.velocities = xyz_of(state_.from.velocities);
        result.predicted = xyz_of(state_.predicted.values);
        result.compliances = w_of(state_.predicted.values);
        result.loads = xyz_of(system_.loads());
        result.inertia = w_of(system_.loads());
        result.guesses = xyz_of(system_.displacements());
        for (const float enough : download(system_.enough()))
            result.enough.push_back(static_cast<double>(enough));
        result.enough.resize(model_.body_count());
        // With as many iterations as the reference, whatever rounding is.
        std::vector<float> less(result.enough.begin(), result.enough.end());
        for (float& enough : less) enough *= 1e-3f;
        system_.enough().upload(less);
        system_.begin_bodies(state_.from);
        system_.solve(state_.from);
        result.solved = xyz_of(system_.displacements());
        return result;
    }

private:
    gpu::RowCapacity capacity() const {
        return model_.colliders.empty() ? gpu::RowCapacity{}
                                        : gpu::RowCapacity{case_.capacity, model_.body_count()};
    }

    const StartCase& case_;
    const Model& model_;
    gpu::ModelBuffers buffers_;
    ContactSurface surface_;
    gpu::StepState state_;
    gpu::StepSystem system_;
    gpu::PartStart start_;
    std::optional<gpu::SumLoads> loads_;
};

// Of values that differ by their size at most by rounding.
class Errors {
public:
    /// @param scale of what counts as wrong
    void add(double actual, double expected, double scale) {
        const double error = std::abs(actual - expected) / scale;
        worst_ = std::isfinite(error) ? std::max(worst_, error) : kInfinite;
    }
    void add(const glm::dvec3& actual, const glm::dvec3& expected, double scale) {
        add(glm::distance(actual, expected), 0.0, scale);
    }
    /// By the root of the mean square of what is expected.
    void add(const Field& actual, const Field& expected, double tolerance) {
        double squares = 0.0;
        for (const glm::dvec3& value : expected) squares += glm::dot(value, value);
        const double scale = tolerance * std::sqrt(squares / static_cast<double>(expected.size())) + 1e-30;
        for (std::size_t n = 0; n < expected.size(); ++n) add(actual[n], expected[n], scale);
    }
    /// By each that is expected.
    void add(const std::vector<double>& actual, const std::vector<double>& expected, double tolerance) {
        for (std::size_t n = 0; n < expected.size(); ++n)
            add(actual[n], expected[n], tolerance * std::abs(expected[n]) + 1e-30);
    }
    void require(bool is_right) { add(is_right ? 0.0 : kInfinite, 0.0, 1.0); }

    double worst() const { return worst_; }

private:
    static constexpr double kInfinite = std::numeric_limits<double>::infinity();
    double worst_ = 0.0;
};

using Rows = std::vector<ContactRow<double>>;

void sort_by_key(Rows& rows) {
    std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
}

// Forces by what a contact exerts over a length that counts.
void compare_rows(Rows actual, Rows expected, Errors& errors) {
    errors.require(actual.size() == expected.size());
    if (actual.size() != expected.size()) return;
    sort_by_key(actual);
    sort_by_key(expected);
    for (std::size_t r = 0; r < expected.size(); ++r) {
        const ContactRow<double>&a = actual[r], &e = expected[r];
        errors.require(a.key == e.key && a.other == e.other);
        const double length = 1e-6, force = e.stiffness * length;
        errors.add(a.normal, e.normal, 1e-5);
        errors.add(a.gap, e.gap, length);
        errors.add(a.ease, e.ease, length);
        errors.add(a.reach, e.reach, length);
        errors.add(a.stiffness, e.stiffness, 1e-5 * e.stiffness);
        errors.add(a.damping, e.damping, 1e-3 * e.damping + 1e-30);
        errors.add(a.friction, e.friction, 1e-6);
        errors.add(a.hold, e.hold, force);
        errors.add(a.limit, e.limit, force + 1e-3 * e.limit);
    }
}

void compare_bodies(const std::vector<BodyPace>& actual, const std::vector<BodyPace>& expected,
                    Errors& errors) {
    for (std::size_t o = 0; o < expected.size(); ++o) {
        const BodyPace &a = actual[o], &e = expected[o];
        errors.require(a.pace == e.pace && a.is_struck == e.is_struck && a.is_held == e.is_held &&
                       a.held_count == e.held_count);
        errors.require(a.past == e.past && a.damping == e.damping);
        const double mass = static_cast<double>(e.velocity.w);
        errors.add(a.velocity.w, e.velocity.w, 1e-5 * mass);
        errors.add(glm::dvec3(a.velocity), glm::dvec3(e.velocity), 1e-5);
    }
}

double start_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    OnGpu gpu(at, inputs);
    const bool is_untouched = gpu.run();
    const StartResult actual = gpu.result();
    Errors errors;
    errors.require(is_untouched && actual.clock.tries == expected.clock.tries);
    errors.require(actual.clock.parts == expected.clock.parts);
    errors.require(actual.clock.has_past == expected.clock.has_past);
    errors.add(actual.clock.step, expected.clock.step, 1e-6 * expected.clock.step);
    errors.add(actual.velocities, expected.velocities, 1e-5);
    errors.add(actual.predicted, expected.predicted, 1e-5);
    errors.add(actual.compliances, expected.compliances, 1e-5);
    compare_bodies(actual.paces, expected.paces, errors);
    compare_rows(actual.rows, expected.rows, errors);
    errors.add(actual.inertia, expected.inertia, 1e-5);
    errors.add(actual.guesses, expected.guesses, 1e-4);
    errors.add(actual.loads, expected.loads, 1e-4);
    errors.add(actual.enough, expected.enough, 1e-4);
    // Of contacts with a reach of a thousandth gaps are near rounding; of wrong tables nothing is right.
    errors.add(actual.solved, expected.solved, 4e-2);
    return errors.worst();
}

// Rows for which there is no place are left out, and counted.
double capacity_error(const StartCase& at) {
    const auto [inputs, expected] = part_start_reference(at);
    OnGpu gpu(at, inputs);
    const bool is_untouched = gpu.run();
    const StartResult actual = gpu.result();
    Errors errors;
    errors.require(is_untouched);
    errors.require(actual.clock.row_count == at.capacity);
    errors.require(actual.clock.dropped_rows + at.capacity == expected.rows.size());
    errors.require(actual.paces[1].row_end == at.capacity && actual.paces[0].first_row == 0);
    for (const glm::dvec3& d : actual.solved) errors.add(glm::length(d), 0.0, 0.1);
    return errors.worst();
}

// After the step is over nothing is done.
double over_error(const StartCase& at) {
    OnGpu gpu(at, part_start_reference(at).first);
    gpu.run();
    StepClock clock = gpu.read_clock();
    clock.is_over = 1;
    gpu.state().clock.upload(std::vector{clock});
    gpu.run();
    return error_if(gpu.read_clock().tries != clock.tries || gpu.read_clock().goes_on != 0);
}

struct Bodies {
    glm::dvec3 velocity{0.3, -0.8, 0.1};  // of the first [m/s]
    bool is_held = false, has_loads = false, has_solids = false, has_planes = true, has_fast_node = false;
    float height = 0.0f;  // above planes; 0: some nodes are inside [m]
};

std::vector<ColliderDescription> colliders_of(const Bodies& at) {
    std::vector<ColliderDescription> colliders;
    const auto add = [&](const auto& shape, const glm::dvec3& position, double friction) {
        ColliderDescription& collider = colliders.emplace_back();
        collider.shape = shape;
        collider.position = position;
        collider.friction = friction;
    };
    if (at.has_planes) {
        add(PlaneCollider{{0, 1, 0}, 0.0}, {}, 0.4);
        add(PlaneCollider{glm::normalize(glm::dvec3(1, 0.1, 0)), -0.002}, {}, 0.2);
    }
    if (at.has_solids) {
        add(Shape(BoxShape{{0.2, 0.1, 0.2}}), {0.15, -0.051, 0.15}, 0.5);
        add(Shape(SphereShape{0.2}), {1.1, -0.201, 0.1}, 0.3);
        add(Shape(CapsuleShape{0.1, 0.3}), {-0.101, 0.15, 0.1}, 0.1);
    }
    return colliders;
}

// A soft body of two chunks and springs, and a small stiff one of neo-Hookean tets; some nodes are inside.
std::shared_ptr<const Model> make_bodies(const Bodies& at) {
    std::vector<Body> bodies;
    Body body = make_body(make_block({6, 6, 7}, {0.3, 0.3, 0.35}, 0.15, 1));
    body.velocity = at.velocity;
    body.spin = {1.0, 2.0, -1.5};
    body.material.youngs_modulus = 2e4;
    body.material.damping = 0.002;
    if (at.is_held) body.pins = {HalfSpaceRegion{{0.0, -1.0, 0.0}, -0.24}};
    if (at.has_loads) body.loads = {{HalfSpaceRegion{{0.0, 0.0, 1.0}, 0.3}, ForceLoad{{5.0, 2.0, -8.0}}}};
    bodies.push_back(body);
    Body small = make_body(make_block({2, 2, 2}, glm::dvec3(0.2), 0.15, 2));
    small.velocity = {0.0, -0.2, 0.1};
    small.spin = {-3.0, 1.0, 0.5};
    for (glm::dvec3& p : small.mesh.positions) p += glm::dvec3(1.0, 0.0, 0.0);
    small.material.model = MaterialModel::neo_hookean;
    small.material.springs.reset();
    small.material.youngs_modulus = 5e6;
    bodies.push_back(small);
    Model model = pack_bodies(bodies, colliders_of(at), {0.5, -9.81, 0.0});
    shake_nodes(model, 0.0003f);
    for (glm::vec4& x : model.positions) x += glm::vec4(at.height, at.height, 0.0f, 0.0f);
    for (std::uint32_t n = 0; n < model.node_count(); ++n)  // of handles
        if (model.positions[n].w == 0.0f) model.velocities[n] = glm::vec4(0.2f, -0.1f, 0.05f, 0.0f);
    if (at.has_fast_node) model.velocities[5].z = 12.0f;  // of the first chunk
    return std::make_shared<const Model>(std::move(model));
}

// Between two planes; some touch neither.
std::shared_ptr<const Model> make_many_bodies() {
    std::vector<ColliderDescription> planes(2);
    planes[0].shape = PlaneCollider{{0, 1, 0}, 0.0};
    planes[1].shape = PlaneCollider{{0, -1, 0}, -0.102};
    std::vector<Block> blocks;
    for (int k = 0; k < 270; ++k) {
        const bool is_small = k % 3 == 0;
        blocks.push_back({.place = {0.2 * k, is_small ? 0.03 : 0.001, 0.0},
                          .velocity = {0.0, k % 2 == 0 ? -0.6 : 0.6, 0.0},
                          .cells = {1, 1, 1},
                          .size = glm::dvec3(is_small ? 0.05 : 0.1)});
    }
    return make_blocks(blocks, {0, -9.81, 0}, planes);
}

constexpr float kPart = 1.0f / 240.0f;

}  // namespace

Scenarios part_start_scenarios() {
    Scenarios scenarios;
    const auto add = [&](const char* name, const Bodies& bodies, StartCase at) {
        scenarios.push_back({name, [bodies, at] {
                                 StartCase with_model = at;
                                 with_model.model = make_bodies(bodies);
                                 return start_error(with_model);
                             }});
    };
    // Those that find most errors come first.
    add("all_kinds_of_colliders", {.has_solids = true}, {.last_step = 0.9f * kPart, .has_memory = true});
    add("loads_and_hands", {.is_held = true, .has_loads = true}, {.last_step = kPart, .has_pulls = true});
    add("divided", {}, {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true});
    add("still_bodies_are_damped", {.height = 0.001f},
        {.last_step = kPart, .has_memory = true, .paces = {2, 2}});
    add("held_and_divided", {.is_held = true}, {.size = 4.0f * kPart, .divides = true, .last_step = kPart});
    add("second_part", {.is_held = true}, {.size = 4.0f * kPart, .left = 1.5f * kPart, .last_step = kPart});
    add("first_part", {}, {});
    add("no_colliders", {.has_planes = false}, {.last_step = 0.9f * kPart});
    add("known_contacts", {}, {.last_step = 0.9f * kPart, .has_memory = true});
    add("fast_node", {.has_fast_node = true}, {});
    add("divided_in_two", {.height = 0.001f},
        {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true, .paces = {1, 2}});
    add("not_divided_at_rest", {.height = 0.001f},
        {.size = 4.0f * kPart, .divides = true, .last_step = kPart, .has_memory = true, .paces = {2, 2}});
    add("too_deep", {.velocity = {0.0, -20.0, 0.0}},
        {.size = 4.0f * kPart, .last_step = kPart, .damps = true});
    add("damped", {}, {.last_step = kPart, .damps = true});
    add("struck", {}, {.last_step = kPart, .struck = {1, 0}});
    add("held", {.is_held = true}, {.last_step = kPart});
    add("carried", {.is_held = true, .has_planes = false}, {.last_step = kPart});
    add("loads", {.has_loads = true, .has_planes = false}, {.last_step = kPart});
    add("hands", {.has_planes = false}, {.last_step = kPart, .has_pulls = true});
    scenarios.push_back({"many_bodies", [] {
                             StartCase at{make_many_bodies()};
                             at.paces.assign(at.model->body_count(), 0);
                             at.struck = at.paces;
                             return start_error(at);
                         }});
    scenarios.push_back(
        {"too_many_rows", [] { return capacity_error({.model = make_bodies({}), .capacity = 70}); }});
    scenarios.push_back({"over", [] { return over_error({make_bodies({})}); }});
    return scenarios;
}

void run_part_start() {
    start_error({.model = make_bodies({.has_loads = true}), .size = 4.0f * kPart, .divides = true});
}

}  // namespace gelatin::test
