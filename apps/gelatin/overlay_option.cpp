#include "overlay_option.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/choice.h"
#include "core/counted.h"
#include "model/scene/limits.h"

namespace gelatin {
namespace {

constexpr const char* kOption = "--overlay";
constexpr Limit kLevels{"a whole number from 0 to 12",
                        [](double v) { return v >= 0.0 && v <= 12.0 && v == std::floor(v); }};
constexpr Limit kStrain{"a strain from 0.0001 to 1", [](double v) { return v >= 1e-4 && v <= 1.0; }};
constexpr Limit kStretch{"a stretch above 1, up to 1000", [](double v) { return v > 1.0 && v <= 1e3; }};
constexpr Limit kStress{"a stress above 0, up to 1e15 Pa", [](double v) { return v > 0.0 && v <= 1e15; }};
constexpr Limit kSpeed{"a speed above 0, up to 1e6 m/s", [](double v) { return v > 0.0 && v <= 1e6; }};
constexpr Limit kPressure{"a pressure above 0, up to 1e15 Pa", [](double v) { return v > 0.0 && v <= 1e15; }};
constexpr Limit kForceScale{"a length from 1e-9 to 1e6 m for each newton",
                            [](double v) { return v >= 1e-9 && v <= 1e6; }};
constexpr Limit kTime{"a time from 0.0001 to 100 s", [](double v) { return v >= 1e-4 && v <= 100.0; }};
constexpr Limit kCoordinate{"between -1e6 and 1e6", [](double v) { return std::abs(v) <= 1e6; }};
constexpr double kUsualLevels = 0.0, kUsualStrain = 0.1, kUsualTime = 0.1;
constexpr const char* kCutForms =
    "must be cut:x, cut:y, cut:z or cut:NX:NY:NZ, a direction, and may end in another number, the offset "
    "along it "
    "[m]; -x, -y and -z are the other side";

enum class Kind {
    boxes,
    faces,
    springs,
    stretch,
    stress,
    speed,
    pressure,
    cut,
    velocity,
    forces,
    objects,
    wireframe,
    attachments,
    bones
};

// "NAME", or with fields "NAME:FIELD:FIELD".
struct Request {
    explicit Request(const std::string& whole) : text(whole) {
        std::size_t begin = 0;
        for (std::size_t colon = whole.find(':'); colon != std::string::npos;
             colon = whole.find(':', begin)) {
            fields.push_back(whole.substr(begin, colon - begin));
            begin = colon + 1;
        }
        fields.push_back(whole.substr(begin));
        name = fields.front();
        fields.erase(fields.begin());
        kind = choose<Kind>(kOption, name,
                            {{"boxes", Kind::boxes},
                             {"faces", Kind::faces},
                             {"springs", Kind::springs},
                             {"stretch", Kind::stretch},
                             {"stress", Kind::stress},
                             {"speed", Kind::speed},
                             {"pressure", Kind::pressure},
                             {"cut", Kind::cut},
                             {"velocity", Kind::velocity},
                             {"forces", Kind::forces},
                             {"objects", Kind::objects},
                             {"wireframe", Kind::wireframe},
                             {"attachments", Kind::attachments},
                             {"bones", Kind::bones}});
    }

    double number(std::size_t field, const Limit& limit) const {
        const std::string& word = fields[field];
        double value = 0.0;
        const char* end = word.data() + word.size();
        const auto [read, status] = std::from_chars(word.data(), end, value);
        if (status != std::errc() || read != end || !limit.holds(value))
            refuse(fmt::format("the number must be {}", limit.allowed));
        return value;
    }
    // The only number that is allowed.
    double number_or(double usual, const Limit& limit) const {
        allow(1);
        return fields.empty() ? usual : number(0, limit);
    }
    void allow(std::size_t most) const {
        if (fields.size() <= most) return;
        refuse(most == 0 ? fmt::format("{} takes no number", name)
                         : fmt::format("{} takes no more than {}", name, counted(most, "field")));
    }
    [[noreturn]] void refuse(const std::string& problem) const {
        throw InvalidInput({{}, 0, kOption, text, problem});
    }

    std::string text, name;
    std::vector<std::string> fields;
    Kind kind;
};

void show_boxes(const Request& request, Overlays& overlays) {
    request.allow(2);
    if (request.fields.size() == 2 && request.fields[1] != "alone")
        request.refuse("behind the number there may be 'alone', for the boxes of that level and no other");
    overlays.box_levels =
        static_cast<int>(request.fields.empty() ? kUsualLevels : request.number(0, kLevels));
    overlays.lowest_boxes_alone = request.fields.size() == 2;
}

// Springs and the quantities both colour the bodies, so they exclude each other.
void check_colors(const Request& request, const Overlays& overlays) {
    if (overlays.full_strain || overlays.color_map)
        request.refuse("of springs, stretch, stress, speed and pressure one can be shown");
}

void show_quantity(const Request& request, Quantity quantity, const Limit& limit, Overlays& overlays) {
    check_colors(request, overlays);
    request.allow(1);
    overlays.color_map = ColorMap{.quantity = quantity};
    if (!request.fields.empty()) overlays.color_map->full = static_cast<float>(request.number(0, limit));
}

void show_cut(const Request& request, Overlays& overlays) {
    CutPlane cut{.normal = {0.0f, 0.0f, 0.0f}};
    const auto& fields = request.fields;
    if (fields.empty()) request.refuse(kCutForms);
    const std::string axis = fields[0].starts_with('-') ? fields[0].substr(1) : fields[0];
    const bool is_axis = axis == "x" || axis == "y" || axis == "z";
    const std::size_t direction = is_axis ? 1 : 3;
    if (fields.size() < direction || fields.size() > direction + 1) request.refuse(kCutForms);
    if (is_axis) {
        cut.normal[axis[0] - 'x'] = fields[0].starts_with('-') ? -1.0f : 1.0f;
    } else {
        for (std::size_t k = 0; k < 3; ++k)
            cut.normal[k] = static_cast<float>(request.number(k, kCoordinate));
        const auto is_small = [](float v) { return std::abs(v) < 1e-6f; };
        if (std::all_of(std::begin(cut.normal), std::end(cut.normal), is_small))
            request.refuse("the direction must not be zero");
    }
    if (fields.size() > direction) cut.offset = static_cast<float>(request.number(direction, kCoordinate));
    overlays.cut = cut;
}

void show(const Request& request, Overlays& overlays) {
    switch (request.kind) {
        case Kind::boxes:
            return show_boxes(request, overlays);
        case Kind::faces:
            request.allow(0);
            overlays.faces = true;
            return;
        case Kind::springs:
            check_colors(request, overlays);
            overlays.full_strain = static_cast<float>(request.number_or(kUsualStrain, kStrain));
            return;
        case Kind::stretch:
            return show_quantity(request, Quantity::stretch, kStretch, overlays);
        case Kind::stress:
            return show_quantity(request, Quantity::stress, kStress, overlays);
        case Kind::speed:
            return show_quantity(request, Quantity::speed, kSpeed, overlays);
        case Kind::pressure:
            return show_quantity(request, Quantity::pressure, kPressure, overlays);
        case Kind::cut:
            return show_cut(request, overlays);
        case Kind::velocity:
            overlays.arrow_time = static_cast<float>(request.number_or(kUsualTime, kTime));
            return;
        case Kind::forces:
            request.allow(1);
            overlays.contact_forces = ForceArrows{};
            if (!request.fields.empty())
                overlays.contact_forces->scale = static_cast<float>(request.number(0, kForceScale));
            return;
        case Kind::objects:
            request.allow(0);
            overlays.objects = true;
            return;
        case Kind::wireframe:
            request.allow(0);
            overlays.wireframe = true;
            return;
        case Kind::attachments:
            request.allow(0);
            overlays.attachments = true;
            return;
        case Kind::bones:
            request.allow(0);
            overlays.bones = true;
            return;
    }
}

}  // namespace

Overlays parse_overlays(const std::vector<std::string>& texts) {
    Overlays overlays;
    for (const std::string& text : texts) show(Request(text), overlays);
    return overlays;
}

}  // namespace gelatin
