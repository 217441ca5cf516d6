#include "model/drive/check_regions.h"

#include <fmt/core.h>

#include <algorithm>

#include "gelatin/error.h"
#include "model/drive/loads.h"
#include "model/region.h"
#include "model/setting_names.h"

namespace gelatin {
namespace {

// Whether it acts like a pin: then it does not matter which of them holds a node, until somebody drags one.
bool rests(const HandleDescription& handle) {
    return handle.keyframes.empty() && !handle.release && !handle.skeleton;
}

constexpr const char* kWorld = "(regions are in world coordinates at the start)";

class RegionCheck {
public:
    RegionCheck(const std::filesystem::path& file, const ObjectDescription& object, const TetMesh& mesh)
        : file_(file), object_(object), mesh_(mesh), holders_(mesh.positions.size()) {}

    void check_pins() {
        for (std::uint32_t n = 0; n < holders_.size(); ++n) {
            if (any_holds(object_.pins, mesh_.positions[n])) holders_[n] = {"a pin", true};
        }
        const bool hold_none = std::all_of(holders_.begin(), holders_.end(),
                                           [](const Holder& holder) { return holder.name.empty(); });
        if (!object_.pins.empty() && hold_none)
            fail(object_.pins_line, "pins", fmt::format("hold no node of the object {}", kWorld));
    }

    void check_handles(const std::vector<std::vector<std::uint32_t>>& held) {
        for (std::size_t h = 0; h < object_.handles.size(); ++h) {
            const HandleDescription& handle = object_.handles[h];
            const std::string field = fmt::format("handle[{}]", h),
                              where = field + (handle.skeleton ? ".skeleton" : ".region");
            if (held[h].empty())
                fail(handle.line, where,
                     fmt::format("holds no node of the object {}",
                                 handle.skeleton ? "(which it is placed with)" : kWorld));
            for (const std::uint32_t n : held[h]) {
                const Holder& other = holders_[n];
                if (!other.name.empty() && !(other.rests && rests(handle))) {
                    fail(handle.line, where, fmt::format("must not share a node with {}", other.name));
                }
                holders_[n] = {field, rests(handle)};
            }
        }
    }

    void check_loads() const {
        for (std::size_t l = 0; l < object_.loads.size(); ++l) {
            const LoadDescription& load = object_.loads[l];
            const bool acts_on_nodes = std::holds_alternative<ForceLoad>(load.kind);
            const bool is_empty = acts_on_nodes ? find_inside(load.region, mesh_.positions).empty()
                                                : find_faces_inside(load.region, mesh_).empty();
            if (!is_empty) continue;
            fail(load.line, fmt::format("load[{}].region", l),
                 fmt::format("holds no {} of the object {}", acts_on_nodes ? "node" : "whole face", kWorld));
        }
    }

private:
    [[noreturn]] void fail(int line, const std::string& field, const std::string& problem) const {
        throw InvalidInput({file_.string(),
                            line,
                            fmt::format("{}.{}.{}", table_name(object_), object_.name, field),
                            {},
                            problem});
    }

    struct Holder {
        std::string name;  // empty: nothing
        bool rests = true;
    };

    const std::filesystem::path& file_;
    const ObjectDescription& object_;
    const TetMesh& mesh_;
    std::vector<Holder> holders_;  // for each node, what holds it already
};

}  // namespace

void check_regions(const std::filesystem::path& file, const ObjectDescription& object, const TetMesh& mesh,
                   const std::vector<std::vector<std::uint32_t>>& held) {
    RegionCheck check(file, object, mesh);
    check.check_pins();
    check.check_handles(held);
    check.check_loads();
}

}  // namespace gelatin
