#include "sim/report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "gelatin/version.h"
#include "model/assembly/collider_surface.h"
#include "model/model.h"
#include "model/setting_names.h"
#include "sim/simulator_internals.h"

namespace gelatin {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the documented order

Json settings_json(const RunReport& report) {
    const SimulationSettings& settings = report.settings;
    const glm::dvec3 gravity = settings.gravity.value_or(Scene().gravity());
    const std::optional<double>& proximity_radius = report.collision.proximity_radius;
    const Json radius = proximity_radius ? Json(*proximity_radius) : Json();
    return {{"solver", name_of(settings.solver)},
            {"forces", name_of(settings.forces)},
            {"frame_rate", settings.frame_rate},
            {"substeps", report.substeps},
            {"iterations", settings.iterations},
            {"step_size", report.step_size},
            {"frames", settings.frames},
            {"broad_phase", name_of(report.collision.broad_phase)},
            {"detection", name_of(report.collision.detection)},
            {"response", name_of(report.collision.response_with(settings.solver))},
            {"self_collision", report.collision.self_collision_with(settings.solver)},
            {"proximity_radius", radius},
            {"gravity", {gravity.x, gravity.y, gravity.z}}};
}

Json counts_json(const Counts& counts) {
    return {{"objects", counts.objects},
            {"nodes", counts.nodes},
            {"springs", counts.springs},
            {"faces", counts.faces},
            {"tets", counts.tets}};
}

// Infinity, if nothing is near, becomes null.
void add_proximities(const ProximityStatistics& proximities, Json& frame) {
    frame["proximities"] = {{"node_face", proximities.node_face},
                            {"edge_edge", proximities.edge_edge},
                            {"lost", proximities.lost}};
    frame["nearest_gap"] = proximities.nearest_gap;
}

Json contact_forces_json(const std::vector<ContactForce>& forces, const RunReport& report) {
    Json list = Json::array();
    for (const ContactForce& force : forces) {
        list.push_back(
            {{"object", report.objects[force.object]},
             {"from", force.collider ? report.colliders[*force.collider] : report.objects[*force.other]},
             {"normal", force.normal},
             {"friction", force.friction},
             {"points", force.points}});
    }
    return list;
}

// Pins and handles have no names; they count from 0, as in overrides.
Json holding_forces_json(const std::vector<HoldingForce>& forces, const RunReport& report) {
    Json list = Json::array();
    for (const HoldingForce& force : forces) {
        list.push_back({{"object", report.objects[force.object]},
                        {force.is_pin ? "pin" : "handle", force.index},
                        {"force", force.force},
                        {"torque", force.torque}});
    }
    return list;
}

Json attachments_json(const std::vector<AttachmentStatus>& attachments) {
    Json list = Json::array();
    for (const AttachmentStatus& attachment : attachments) {
        list.push_back(
            {{"name", attachment.name}, {"force", attachment.force}, {"is_broken", attachment.is_broken}});
        if (const auto& joint = attachment.joint)
            list.back()["joint"] = {
                {"position", joint->position}, {"speed", joint->speed}, {"effort", joint->effort}};
    }
    return list;
}

Json cavities_json(const std::vector<CavityStatus>& cavities, const RunReport& report) {
    Json list = Json::array();
    for (const CavityStatus& cavity : cavities)
        list.push_back({{"name", cavity.name},
                        {"object", report.objects[cavity.object]},
                        {"volume", cavity.volume},
                        {"pressure", cavity.pressure}});
    return list;
}

Json frame_json(const FrameStatistics& frame, const RunReport& report) {
    const std::vector<std::string>& objects = report.objects;
    Json volume_ratio = Json::object();
    for (std::size_t o = 0; o < objects.size() && o < frame.volume_ratio.size(); ++o) {
        volume_ratio[objects[o]] = frame.volume_ratio[o];
    }
    Json json = {{"frame", frame.frame},
                 {"time", frame.time},
                 {"kinetic_energy", frame.kinetic_energy},
                 {"elastic_energy", frame.elastic_energy},
                 {"potential_energy", frame.potential_energy},
                 {"momentum", frame.momentum},
                 {"colliding_faces", frame.colliding_faces},
                 {"contacts", frame.contacts},
                 {"deepest_penetration", frame.deepest_penetration},
                 {"volume_ratio", volume_ratio}};
    if (frame.proximities) add_proximities(*frame.proximities, json);
    if (report.collision.response_with(report.settings.solver) == CollisionResponse::contact)
        json["contact_forces"] = contact_forces_json(frame.contact_forces, report);
    if (!frame.holding_forces.empty())
        json["holding_forces"] = holding_forces_json(frame.holding_forces, report);
    if (!frame.attachments.empty()) json["attachments"] = attachments_json(frame.attachments);
    if (!frame.cavities.empty()) json["cavities"] = cavities_json(frame.cavities, report);
    return json;
}

Json spread_json(const std::vector<double>& milliseconds) {
    if (milliseconds.empty()) return {{"median", 0.0}, {"mean", 0.0}, {"p95", 0.0}, {"max", 0.0}};
    const double sum = std::accumulate(milliseconds.begin(), milliseconds.end(), 0.0);
    return {{"median", percentile(milliseconds, 0.5)},
            {"mean", sum / static_cast<double>(milliseconds.size())},
            {"p95", percentile(milliseconds, 0.95)},
            {"max", *std::max_element(milliseconds.begin(), milliseconds.end())}};
}

Json timing_json(const RunReport& report) {
    Json stages = Json::object();
    for (const auto& [name, milliseconds] : report.stage_ms) {
        stages[name] = spread_json(milliseconds);
        stages[name]["runs"] = milliseconds.size();
    }
    const auto frames = static_cast<double>(report.frame_ms.size());
    Json frame_ms = spread_json(report.frame_ms);
    frame_ms["each"] = report.frame_ms;
    return {{"fps", report.seconds > 0.0 ? frames / report.seconds : 0.0},
            {"frame_ms", frame_ms},
            {"stages", stages}};
}

}  // namespace

RunReport describe_run(const Simulator& simulator) {
    RunReport report;
    report.scene = simulator.scene().file.string();
    report.backend = simulator.backend();
    report.device = simulator.device();
    report.settings = simulator.scene().simulation;
    report.settings.gravity = simulator.scene().gravity();
    report.collision = simulator.scene().collision;
    report.substeps = simulator.substeps();
    report.step_size = simulator.step_size();
    report.counts = simulator.counts();
    for (const ModelObject& object : model_of(simulator).bodies()) report.objects.push_back(object.name);
    const std::vector<ColliderDescription>& colliders = simulator.scene().colliders;
    for (std::size_t c = 0; c < colliders.size(); ++c)
        report.colliders.push_back(name_of_collider(colliders[c], c));
    return report;
}

std::string to_json(const RunReport& report) {
    Json frames = Json::array();
    for (const FrameStatistics& frame : report.frames) frames.push_back(frame_json(frame, report));
    const Json document = {{"gelatin", {{"version", version()}, {"commit", commit()}}},
                           {"scene", report.scene},
                           {"backend", report.backend},
                           {"device", report.device},
                           {"settings", settings_json(report)},
                           {"counts", counts_json(report.counts)},
                           {"frames", std::move(frames)},
                           {"timing", timing_json(report)}};
    // Names and paths may contain bytes that are not UTF-8, which JSON cannot represent.
    return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

double percentile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0.0;
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace gelatin
