#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "mesh/ignored.h"
#include "mesh/obj_materials.h"
#include "mesh/surface_readers.h"
#include "mesh/text_scanner.h"

namespace gelatin {
namespace {

constexpr std::uint32_t kNone = ~0u;

float texture_coordinate(double value) {
    return std::abs(value) <= std::numeric_limits<float>::max() ? static_cast<float>(value) : 0.0f;
}

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, std::string_view content, Notes& notes)
        : scanner_(file, content, '#', true), materials_(file, notes) {}

    SurfacePolygons read(Notes& notes) {
        for (; !scanner_.at_end(); scanner_.skip_line()) read_statement();
        if (forward_ && highest_ >= polygons_.positions.size()) fail_vertex(*forward_, forward_corner_);
        set_uvs();
        materials_.finish(polygons_);
        ignored_.report(notes);
        return std::move(polygons_);
    }

private:
    void read_statement() {
        const std::string keyword = lower_case(scanner_.word("keyword"));
        if (keyword == "v") {
            read_vertex();
        } else if (keyword == "f" || keyword == "fo") {  // fo: of the first versions
            read_face();
        } else if (keyword == "vt") {
            read_uv();
        } else if (keyword == "usemtl") {
            material_ = materials_.number_of(scanner_.rest_of_line());
        } else if (keyword == "mtllib") {
            materials_.read_libraries(scanner_.rest_of_line());
        } else if (keyword == "l") {
            ignored_.add("lines");
        } else if (keyword == "p") {
            for (; !scanner_.at_line_end(); scanner_.word("point")) ignored_.add("points");
        } else {
            constexpr std::array kOfNoUse = {"vn", "g", "o", "s", "mg"};
            if (std::find(kOfNoUse.begin(), kOfNoUse.end(), keyword) == kOfNoUse.end())
                ignored_.add("statements '" + printable(keyword) + "'");
        }
    }

    // x y z, then a weight for curves, or a colour, or both.
    void read_vertex() {
        const FieldName field("vertex", polygons_.positions.size() + 1);
        glm::dvec3 position;
        for (int axis = 0; axis < 3; ++axis) {
            if (scanner_.at_line_end()) scanner_.fail(field, {}, "must have three coordinates");
            position[axis] = scanner_.coordinate(field);
        }
        polygons_.positions.push_back(position);
        if (scanner_.at_line_end()) return;
        const double weight = scanner_.number(field);
        int more = 0;
        for (; !scanner_.at_line_end(); ++more) scanner_.number(field);
        if (more > 0) ignored_.add("colours of vertices");
        if (more == 0 && weight != 1.0) ignored_.add("weights of vertices");
    }

    void read_uv() {
        const FieldName field("texture coordinate", uvs_.size() + 1);
        glm::vec2 uv(0.0f);
        for (int axis = 0; axis < 2 && !scanner_.at_line_end(); ++axis)
            uv[axis] = texture_coordinate(scanner_.number(field));
        uvs_.push_back(uv);
    }

    void read_face() {
        std::uint32_t size = 0;
        for (; !scanner_.at_line_end(); ++size) read_corner(scanner_.word("face"));
        polygons_.sizes.push_back(size);
        polygons_.polygon_materials.push_back(material_);
    }

    // "12", "12/3", "12//4", "12/3/4"; negative numbers count back from the last vertex so far.
    void read_corner(std::string_view corner) {
        const char *at = corner.data(), *const end = at + corner.size();
        const auto take_number = [&](std::size_t count) -> std::optional<long long> {
            long long number = 0;
            const auto [stop, error] = std::from_chars(at, end, number);
            if (error != std::errc()) return {};
            at = stop;
            return number < 0 ? static_cast<long long>(count) + number : number - 1;
        };
        const std::optional<long long> vertex = take_number(polygons_.positions.size());
        if (!vertex || *vertex < 0 || *vertex >= kNone || (at != end && *at != '/'))
            fail_vertex(scanner_, corner);
        const auto index = static_cast<std::uint32_t>(*vertex);
        if (index >= polygons_.positions.size() && (!forward_ || index > highest_)) {
            forward_.emplace(scanner_);
            forward_corner_ = corner;
            highest_ = index;
        }
        polygons_.corners.push_back(index);

        std::optional<long long> uv;
        if (at != end && ++at != end) uv = take_number(uvs_.size());
        const bool is_uv = uv && *uv >= 0 && *uv < kNone;
        corner_uvs_.push_back(is_uv ? static_cast<std::uint32_t>(*uv) : kNone);
        if (uv && !is_uv) ++lost_uvs_;
    }

    void set_uvs() {
        if (!uvs_.empty()) {
            polygons_.corner_uvs.reserve(corner_uvs_.size());
            for (const std::uint32_t uv : corner_uvs_) {
                polygons_.corner_uvs.push_back(uv < uvs_.size() ? uvs_[uv] : glm::vec2(0.0f));
            }
        }
        const auto is_lost = [&](std::uint32_t uv) { return uv != kNone && uv >= uvs_.size(); };
        lost_uvs_ += static_cast<std::size_t>(std::count_if(corner_uvs_.begin(), corner_uvs_.end(), is_lost));
        ignored_.add("texture coordinates that faces name and that are not there", lost_uvs_);
    }

    [[noreturn]] void fail_vertex(TextScanner scanner, std::string_view corner) {
        // The message has to name the number of vertices in the whole file.
        for (; !scanner_.at_end(); scanner_.skip_line()) {
            if (lower_case(scanner_.word("keyword")) == "v") polygons_.positions.emplace_back();
        }
        scanner.fail("face", corner,
                     fmt::format("must name a vertex by its number from 1 to {}, or count back from the "
                                 "last by a negative one",
                                 polygons_.positions.size()));
    }

    TextScanner scanner_;
    ObjMaterials materials_;
    Ignored ignored_;
    SurfacePolygons polygons_;
    std::vector<glm::vec2> uvs_;
    std::vector<std::uint32_t> corner_uvs_;  // of each corner; kNone
    std::size_t lost_uvs_ = 0;
    std::uint32_t material_ = SurfaceLook::kNone;
    // The highest vertex that a face names before it is there, and where.
    std::optional<TextScanner> forward_;
    std::string_view forward_corner_;
    std::uint32_t highest_ = 0;
};

}  // namespace

SurfacePolygons read_obj(const std::filesystem::path& file, std::string_view content, Notes& notes) {
    return ObjReader(file, content, notes).read(notes);
}

}  // namespace gelatin
