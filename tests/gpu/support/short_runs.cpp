#include "gpu/support/short_runs.h"

#include <memory>

#include "core/file.h"
#include "gelatin/pull.h"
#include "gelatin/views.h"
#include "gpu/support/implicit_scenarios.h"
#include "mesh/shapes.h"
#include "mesh/surface_file.h"
#include "render/frame_grabber.h"
#include "render/renderer.h"

namespace gelatin::test {
namespace {

// Two bodies that fall into one another and onto a floor, held, pushed and dragged; one of them folds. Each
// is of three materials.
constexpr const char* kScene = R"(
[simulation]
solver = "implicit"
substeps = 3
iterations = 7
frame_rate = 100

[collision]
response = "restore"

[[material]]
name = "jelly"
youngs_modulus = 5e4
damping = 0.02

[[object]]
name = "lower"
shape = { box = [0.9, 0.3, 0.3], segments = [6, 2, 2] }
mesher = { max_volume = 2e-3 }
position = [0, 0.16, 0]
pins = [{ plane = [1, 0, 0], offset = -0.44 }]

[[object.handle]]
region = { plane = [-1, 0, 0], offset = -0.44 }
keyframes = [{ time = 0 }, { time = 1, move = [0, 0.1, 0] }]

[[object.load]]
region = { plane = [0, -1, 0], offset = -0.3 }
pressure = 100

[[object]]
name = "upper"
shape = { sphere = 0.2, frequency = 4 }
position = [0, 0.48, 0]
velocity = [0, -1, 0]

[[collider]]
shape = { plane = [0, 1, 0] }
)";

void pull(Simulator& simulator) {
    Pull hand;
    hand.nodes = {{0, glm::vec3(0.0f), 50.0f}, {7, glm::vec3(0.1f, 0.0f, 0.0f), 50.0f}};
    hand.target = {0.0, 1.0, 0.0};
    simulator.set_pulls({hand});
}

Overlays everything() {
    Overlays all;
    all.box_levels = 2;
    all.faces = true;
    all.color_map = ColorMap{};
    all.cut = CutPlane{};
    all.arrow_time = 0.1f;
    all.contact_forces = ForceArrows{};
    all.objects = true;
    all.wireframe = true;
    all.attachments = true;
    all.bones = true;
    return all;
}

std::vector<Overlays> kinds_of_overlays() {
    std::vector<Overlays> kinds(9);  // the first: none
    kinds[1].box_levels = 2;
    kinds[2].faces = true;
    kinds[3].full_strain = 0.1f;
    kinds[4].color_map = ColorMap{Quantity::stretch, {}};
    kinds[5].color_map = ColorMap{Quantity::speed, {}};
    kinds[6].cut = CutPlane{};
    kinds[7].cut = CutPlane{};  // right after a cut, with nothing between that has a barrier
    kinds[7].arrow_time = 0.1f;
    kinds[8].objects = kinds[8].wireframe = true;
    kinds.emplace_back().color_map = ColorMap{Quantity::pressure, {}};
    kinds.emplace_back().contact_forces = ForceArrows{};
    kinds.emplace_back().attachments = true;
    kinds.emplace_back().bones = true;
    kinds.push_back(everything());
    return kinds;
}

// Pictures of both qualities, with one kind of overlay after the other, then with all.
class Painter {
public:
    explicit Painter(Axis up) {
        const render::Surroundings around{.bounds = {{-1.0f, 0.0f, -1.0f}, {1.0f, 1.0f, 1.0f}},
                                          .floor_height = 0.0f,
                                          .props = {make_sphere({0.1, 4})},
                                          .colors = {},
                                          .up = up};
        for (const render::Quality quality : {render::Quality::high, render::Quality::fast}) {
            renderers_.push_back(std::make_unique<render::Renderer>(
                render::RendererOptions{.width = 96, .height = 64, .quality = quality}));
            renderers_.back()->set_surroundings(around);
        }
    }

    void draw(Simulator& simulator) {
        for (const auto& renderer : renderers_) {
            for (const Overlays& overlays : kinds_of_overlays()) {
                renderer->draw(simulator.render_view(overlays),
                               {.eye = {0.0f, 0.6f, 2.0f}, .target = {0.0f, 0.3f, 0.0f}});
                grabber_.grab(renderer->framebuffer());
            }
        }
    }

private:
    std::vector<std::unique_ptr<render::Renderer>> renderers_;
    render::FrameGrabber grabber_{96, 64};
};

using Change = std::function<void(Scene&)>;

Change both(const Change& first, const Change& second) {
    return [=](Scene& scene) {
        first(scene);
        second(scene);
    };
}

// An explicit scheme, with steps short enough for the scene.
Change explicit_by(SolverKind solver, ForceMethod forces) {
    return [=](Scene& scene) {
        scene.simulation.solver = solver;
        scene.simulation.forces = forces;
        scene.simulation.substeps.reset();
        scene.simulation.frame_rate = 1000.0;
    };
}

void neo_hookean(Scene& scene) {
    scene.materials.front().model = MaterialModel::neo_hookean;
    scene.materials.front().poisson_ratio = 0.45;
}

void volume_term(Scene& scene) {
    scene.materials.front().poisson_ratio = 0.4;
}

void contact(Scene& scene) {
    scene.collision.response = CollisionResponse::contact;
    scene.objects[1].position = {0.1, 0.53, 0.0};
}

// Far from each other.
void contact_apart(Scene& scene) {
    scene.collision.response = CollisionResponse::contact;
    scene.objects[1].position = {0.1, 3.0, 0.0};
}

void attached(Scene& scene) {
    contact_apart(scene);
    scene.attachments.push_back(
        {.object = scene.objects[1].name, .where = AttachedPoint{scene.objects[1].position}});
}

// Bodies that nothing moves, for long enough to sleep.
void at_rest(Scene& scene) {
    contact(scene);
    scene.simulation.gravity = {0.0, 0.0, 0.0};
    scene.simulation.frame_rate = 2.0;
    scene.objects[0].handles.clear();
    scene.objects[0].loads.clear();
    scene.objects[1].velocity = {0.0, 0.0, 0.0};
}

void fall_asleep(Simulator& simulator) {
    for (int frame = 0; frame < 3; ++frame) simulator.advance_frame();
}

// Flat bodies, which get their shapes back.
void squashed(Scene& scene) {
    for (ObjectDescription& object : scene.objects) {
        object.start.scale = {1.0, 0.0, 1.0};
        object.pins.clear();
        object.handles.clear();
    }
}

// One body through another, and through itself.
void tangled(Scene& scene) {
    scene.collision.self_collision = true;
    scene.objects[1].position = {0.1, 0.3, 0.0};
    scene.objects[0].start.scatter = 0.1;
}

Change broad_phase(BroadPhase kind) {
    return [=](Scene& scene) {
        scene.objects[1].position = {0.1, 0.4, 0.0};
        scene.collision.broad_phase = kind;
    };
}

void proximities(Scene& scene) {
    tangled(scene);
    scene.collision.proximity_radius = 0.05;
}

// A body with a surface of its own, which has a material.
void painted(Scene& scene) {
    const std::filesystem::path folder = scene.file.parent_path(), file = folder / "ball.obj";
    write_surface(file, make_sphere({0.2, 6}));
    write_file(file, "mtllib ball.mtl\nusemtl red\n" + read_file(file));
    write_file(folder / "ball.mtl", "newmtl red\nKd 1 0 0\n");
    scene.objects[1].shape = FileShape{file};
    scene.objects[1].mesher = {.kind = MesherKind::lattice};
    scene.objects[1].mesher.nodes = 100;
}

void z_up(Scene& scene) {
    scene.up = Axis::z;
}

void nothing(Scene&) {}

void drag(Simulator& simulator) {
    for (std::size_t i = 0; i < simulator.held_nodes().size(); ++i)
        simulator.drag(i, {.move = {0.0, 0.05, 0.0}, .turn = {1.0, 0.0, 0.0, 0.0}});
}

// Whatever wrote the nodes last, they are read and written from outside behind any step.
void start_again(Simulator& simulator) {
    simulator.step();
    simulator.read_frame();
    simulator.step();
    simulator.reset();
}

void resume(Simulator& simulator) {
    const TemporaryFolder folder;
    simulator.step();
    simulator.save_checkpoint(folder.path() / "state.gel");
    simulator.step();
    simulator.load_checkpoint(folder.path() / "state.gel");
}

// A body on a floor, whose steps are made of more parts than tries are launched at first.
void alone(Scene& scene) {
    scene.objects.resize(1);
    scene.objects[0].pins.clear();
    scene.objects[0].handles.clear();
    scene.objects[0].loads.clear();
    scene.collision.response = CollisionResponse::contact;
    scene.collision.self_collision = false;
    scene.simulation.substeps.reset();
}

}  // namespace

std::vector<ShortRun> short_runs() {
    const Change fused = explicit_by(SolverKind::rk4, ForceMethod::fused);
    const Change divided = explicit_by(SolverKind::midpoint, ForceMethod::divide_and_merge);
    const Change continuous = [](Scene& scene) {
        scene.collision.detection = CollisionDetection::continuous;
    };
    return {
        {"implicit", nothing, start_again, true},
        {"implicit, pulled", nothing, pull},
        {"implicit, resumed", nothing, resume},
        {"implicit, alone", alone, start_again},
        {"implicit, dragged", nothing, drag},
        {"implicit, volume term", volume_term, pull},
        {"implicit, neo-Hookean", neo_hookean, pull},
        {"implicit, squashed", squashed, start_again},
        {"implicit, squashed neo-Hookean", both(squashed, neo_hookean)},
        {"contact", contact, start_again, true},
        {"contact, volume term", both(contact, volume_term), pull},
        {"contact, neo-Hookean", both(contact, neo_hookean)},
        {"contact, apart", contact_apart, start_again, true},
        {"attached", attached, start_again, true},
        {"contact, asleep", at_rest, fall_asleep},
        {"the solve of an implicit step", nothing, [](Simulator&) { run_implicit_programs(); }},
        {"drawn from the CPU", nothing, start_again, true, Backend::cpu},
        {"painted", painted, start_again, true},
        {"painted, drawn from the CPU", painted, start_again, true, Backend::cpu},
        {"drawn with z up", z_up, start_again, true},
        {"fused", fused, pull},
        {"fused, volume term", both(fused, volume_term), start_again},
        {"fused, neo-Hookean", both(fused, neo_hookean)},
        {"fused, Euler", explicit_by(SolverKind::explicit_euler, ForceMethod::fused)},
        {"divided", divided, pull},
        {"divided, volume term", both(divided, volume_term)},
        {"divided, neo-Hookean", both(divided, neo_hookean)},
        {"every face against every face", broad_phase(BroadPhase::none), start_again, true},
        {"boxes", broad_phase(BroadPhase::boxes)},
        {"hierarchy", broad_phase(BroadPhase::hierarchy)},
        {"depth", broad_phase(BroadPhase::depth), start_again, true},
        {"continuous", continuous},
        {"tangled", tangled, start_again, true},
        {"tangled, explicit", both(tangled, fused)},
        {"tangled, continuous", both(tangled, continuous)},
        {"proximities", proximities, pull, true},
    };
}

void play(const ShortRun& run) {
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.toml", kScene);
    Scene scene = load_scene(folder.path() / "scene.toml");
    run.change(scene);
    SimulatorOptions options;
    options.backend = run.backend;
    options.use_current_context = true;
    Simulator simulator(scene, options);
    run.begin(simulator);
    std::unique_ptr<Painter> painter;
    if (run.is_drawn) painter = std::make_unique<Painter>(scene.up);
    for (int frame = 0; frame < 2; ++frame) {
        simulator.advance_frame();
        simulator.begin_statistics();
        if (painter) painter->draw(simulator);
    }
    simulator.begin_statistics();  // twice at one time
    while (simulator.pending_statistics() > 0) simulator.take_statistics();
    simulator.read_frame();
}

}  // namespace gelatin::test
