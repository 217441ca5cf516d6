#include "model/scene/scene_file_cavities.h"

#include "model/scene/scene_file_region.h"

namespace gelatin {
namespace {

CavityKeyframe read_cavity_keyframe(TableReader reader) {
    CavityKeyframe keyframe;
    reader.require({"time"});
    reader.read("time", keyframe.time);
    reader.read("pressure", keyframe.pressure);
    reader.read("amount", keyframe.amount);
    reader.finish();
    return keyframe;
}

}  // namespace

CavityDescription read_cavity(TableReader reader) {
    CavityDescription cavity;
    cavity.line = reader.line();
    reader.read_name("name", cavity.name);
    if (const auto region = reader.table("region")) cavity.region = read_region(*region);
    reader.read("law", cavity.law, {{"sealed", GasLaw::sealed}, {"constant", GasLaw::constant}});
    reader.read("pressure", cavity.pressure);
    reader.read("amount", cavity.amount);
    reader.read("ambient", cavity.ambient);
    for (const TableReader& keyframe : reader.tables("keyframes"))
        cavity.keyframes.push_back(read_cavity_keyframe(keyframe));
    reader.finish();
    return cavity;
}

}  // namespace gelatin
