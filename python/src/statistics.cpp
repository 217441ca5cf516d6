#include "statistics.h"

#include <nanobind/stl/string.h>

#include "sim/report.h"

namespace gelatin::python {
namespace {

namespace nb = nanobind;

nb::object vector_of(const double (&v)[3]) {
    return nb::make_tuple(v[0], v[1], v[2]);
}

nb::dict to_dict(const ContactForce& force, const RunReport& names) {
    nb::dict all;
    all["object"] = names.objects[force.object];
    all["from"] = force.collider ? names.colliders[*force.collider] : names.objects[*force.other];
    all["normal"] = vector_of(force.normal);
    all["friction"] = vector_of(force.friction);
    all["points"] = force.points;
    return all;
}

nb::dict to_dict(const HoldingForce& force, const RunReport& names) {
    nb::dict all;
    all["object"] = names.objects[force.object];
    all[force.is_pin ? "pin" : "handle"] = force.index;
    all["force"] = vector_of(force.force);
    all["torque"] = vector_of(force.torque);
    return all;
}

nb::dict to_dict(const JointStatus& joint) {
    nb::dict all;
    all["position"] = joint.position;
    all["speed"] = joint.speed;
    all["effort"] = joint.effort;
    return all;
}

}  // namespace

nb::list to_list(const std::vector<AttachmentStatus>& attachments) {
    nb::list list;
    for (const AttachmentStatus& attachment : attachments) {
        nb::dict all;
        all["name"] = attachment.name;
        all["force"] = vector_of(attachment.force);
        all["is_broken"] = attachment.is_broken;
        if (attachment.joint) all["joint"] = to_dict(*attachment.joint);
        list.append(all);
    }
    return list;
}

nb::list to_list(const std::vector<CavityStatus>& cavities, const Simulator& simulator) {
    nb::list list;
    for (const CavityStatus& cavity : cavities) {
        nb::dict all;
        all["name"] = cavity.name;
        all["object"] = simulator.object(cavity.object).name;
        all["volume"] = cavity.volume;
        all["pressure"] = cavity.pressure;
        list.append(all);
    }
    return list;
}

nb::dict to_dict(const FrameStatistics& frame, const Simulator& simulator) {
    const RunReport names = describe_run(simulator);
    nb::dict all;
    all["frame"] = frame.frame;
    all["time"] = frame.time;
    all["kinetic_energy"] = frame.kinetic_energy;
    all["elastic_energy"] = frame.elastic_energy;
    all["potential_energy"] = frame.potential_energy;
    all["momentum"] = vector_of(frame.momentum);
    all["colliding_faces"] = frame.colliding_faces;
    all["contacts"] = frame.contacts;
    all["deepest_penetration"] = frame.deepest_penetration;
    nb::dict ratios;
    for (std::size_t o = 0; o < frame.volume_ratio.size(); ++o)
        ratios[names.objects[o].c_str()] = frame.volume_ratio[o];
    all["volume_ratio"] = ratios;
    if (frame.proximities) {
        nb::dict proximities;
        proximities["node_face"] = frame.proximities->node_face;
        proximities["edge_edge"] = frame.proximities->edge_edge;
        proximities["lost"] = frame.proximities->lost;
        all["proximities"] = proximities;
        all["nearest_gap"] = frame.proximities->nearest_gap;
    }
    nb::list contacts, holds;
    for (const ContactForce& force : frame.contact_forces) contacts.append(to_dict(force, names));
    for (const HoldingForce& force : frame.holding_forces) holds.append(to_dict(force, names));
    all["contact_forces"] = contacts;
    all["holding_forces"] = holds;
    all["attachments"] = to_list(frame.attachments);
    all["cavities"] = to_list(frame.cavities, simulator);
    return all;
}

}  // namespace gelatin::python
