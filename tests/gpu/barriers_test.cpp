// Every barrier of the program is needed, and none is missing: short runs of scenes that together reach all
// of them, recorded as the hazard tracker sees them, and played back with each barrier left out in turn.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "core/file.h"
#include "gelatin/simulator.h"
#include "gl/hazards.h"
#include "render/frame_grabber.h"
#include "render/renderer.h"
#include "support/gl_fixture.h"
#include "support/source_path.h"

namespace gelatin {
namespace {

using ::testing::IsEmpty;

// Two bodies that fall into one another and onto a floor, held, pushed and dragged; one of them folds. Each
// is of three materials.
constexpr const char* kScene = R"(
[simulation]
solver = "vbd"
substeps = 3
iterations = 7
frame_rate = 100

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

struct Scenario {
    const char* name;
    std::function<void(Scene&)> change = [](Scene&) {};
    std::function<void(Simulator&)> begin = [](Simulator&) {};
    bool is_drawn = false;
    int frames = 2;
};

void pull(Simulator& simulator) {
    Pull hand;
    hand.nodes = {{0, glm::vec3(0.0f), 50.0f}, {7, glm::vec3(0.1f, 0.0f, 0.0f), 50.0f}};
    hand.target = {0.0, 1.0, 0.0};
    simulator.set_pull(hand);
}

Overlays everything() {
    Overlays all;
    all.box_levels = 2;
    all.faces = true;
    all.color_map = ColorMap{};
    all.cut = CutPlane{};
    all.arrow_time = 0.1f;
    all.objects = true;
    all.wireframe = true;
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
    kinds[7].arrow_time = 0.1f;
    kinds[8].objects = kinds[8].wireframe = true;
    kinds.push_back(everything());
    return kinds;
}

// Pictures of both qualities, with one kind of overlay after the other, then with all.
class Painter {
public:
    Painter() {
        const render::Surroundings around{.bounds = {{-1.0f, 0.0f, -1.0f}, {1.0f, 1.0f, 1.0f}},
                                          .floor_height = 0.0f,
                                          .props = {},
                                          .colors = {}};
        for (const render::Quality quality : {render::Quality::high, render::Quality::fast}) {
            renderers_.push_back(std::make_unique<render::Renderer>(
                render::RendererOptions{.width = 96, .height = 64, .quality = quality}));
            renderers_.back()->set_surroundings(around);
        }
    }

    void draw(Simulator& simulator) {
        for (const Overlays& overlays : kinds_of_overlays()) {
            for (const auto& renderer : renderers_) {
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

std::vector<Scenario> scenarios() {
    const Change fused = explicit_by(SolverKind::rk4, ForceMethod::fused);
    const Change divided = explicit_by(SolverKind::midpoint, ForceMethod::divide_and_merge);
    const Change continuous = [](Scene& scene) {
        scene.collision.detection = CollisionDetection::continuous;
    };
    return {
        {"block descent", nothing, start_again, true},
        {"block descent, pulled", nothing, pull},
        {"block descent, dragged", nothing, drag},
        {"block descent, volume term", volume_term, pull},
        {"block descent, neo-Hookean", neo_hookean, pull},
        {"block descent, squashed", squashed, start_again},
        {"block descent, squashed neo-Hookean", both(squashed, neo_hookean)},
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

class BarriersHeavy : public test::GlTest {
protected:
    struct Recording {
        std::string name;
        std::vector<gl::GpuEvent> events;
    };

    Recording record(const Scenario& scenario) {
        write_file(folder_.path() / "scene.toml", kScene);
        gl::record_gpu_events();
        {
            SimulatorOptions options;
            options.backend = Backend::gl;
            options.use_current_context = true;
            Scene scene = load_scene(folder_.path() / "scene.toml");
            scenario.change(scene);
            Simulator simulator(scene, options);
            scenario.begin(simulator);
            std::optional<Painter> painter;
            if (scenario.is_drawn) painter.emplace();
            for (int frame = 0; frame < scenario.frames; ++frame) {
                simulator.advance_frame();
                simulator.begin_statistics();
                if (painter) painter->draw(simulator);
            }
            simulator.take_statistics();
            simulator.read_frame();
        }
        return {scenario.name, gl::take_gpu_events()};
    }

    TemporaryFolder folder_;
};

// "src/gpu/collision/respond.cpp:31" of each call of barrier() in src/, from the sources.
std::set<std::string> barriers_of_the_sources() {
    std::set<std::string> sites;
    const std::regex call(R"(\bbarrier\([^)])");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_path("src"))) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".cpp") || name.starts_with("barrier") || name.starts_with("hazard")) continue;
        std::istringstream lines(read_file(entry.path()));
        int number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            if (std::regex_search(line.substr(0, line.find("//")), call))
                sites.insert(gl::to_string(gl::CallSite{entry.path().c_str(), number}));
        }
    }
    return sites;
}

std::set<gl::CallSite> sites_of(const std::vector<gl::GpuEvent>& events) {
    std::set<gl::CallSite> sites;
    for (const gl::GpuEvent& event : events) {
        if (const auto* call = std::get_if<gl::BarrierCall>(&event)) sites.insert(call->where);
    }
    return sites;
}

bool has_hazard_without(gl::CallSite site, const std::vector<gl::GpuEvent>& events) {
    gl::HazardTracker tracker;
    tracker.suppress_barrier(site);
    for (const gl::GpuEvent& event : events) tracker.apply(event);
    return !tracker.take_hazards().empty();
}

// The unbroken program has no hazard (GlTest sees to that); without any one of its barriers it has.
TEST_F(BarriersHeavy, AreAllReachedAndAllNeeded) {
    std::map<std::string, bool> is_needed;  // by site
    for (const Scenario& scenario : scenarios()) {
        SCOPED_TRACE(scenario.name);
        const Recording recording = record(scenario);
        EXPECT_THAT(gl::take_hazards(), IsEmpty());
        for (const gl::CallSite site : sites_of(recording.events)) {
            bool& needed = is_needed[gl::to_string(site)];
            needed = needed || has_hazard_without(site, recording.events);
        }
    }
    for (const auto& [site, needed] : is_needed)
        EXPECT_TRUE(needed) << site << " may be removed without anybody noticing";
    for (const std::string& site : barriers_of_the_sources())
        EXPECT_TRUE(is_needed.contains(site)) << site << " is not reached by any run";
    for (const std::string& line : gl::unneeded_barriers()) RecordProperty("unneeded", line);
}

// What a recording says is what happens: a barrier that is not counted in a run is missed there.
TEST_F(BarriersHeavy, AreMissedInARun) {
    const Recording recording = record(scenarios().front());
    const std::set<gl::CallSite> sites = sites_of(recording.events);
    const auto found = std::find_if(sites.begin(), sites.end(), [&](gl::CallSite site) {
        return has_hazard_without(site, recording.events);
    });
    ASSERT_NE(found, sites.end());
    gl::suppress_barrier(*found);
    record(scenarios().front());
    gl::count_all_barriers();
    EXPECT_FALSE(gl::take_hazards().empty());
}

}  // namespace
}  // namespace gelatin
