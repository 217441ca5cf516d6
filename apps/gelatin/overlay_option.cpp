#include "overlay_option.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "choice.h"

namespace gelatin {
namespace {

constexpr const char* kOption = "--overlay";
constexpr Limit kLevels{"a whole number from 0 to 12",
                        [](double v) { return v >= 0.0 && v <= 12.0 && v == std::floor(v); }};
constexpr Limit kStrain{"a strain from 0.0001 to 1", [](double v) { return v >= 1e-4 && v <= 1.0; }};
constexpr double kUsualLevels = 0.0, kUsualStrain = 0.1;

enum class Kind { boxes, faces, springs };

// "NAME" or "NAME:NUMBER".
struct Request {
    explicit Request(const std::string& whole) : text(whole), colon(whole.find(':')) {
        kind = choose<Kind>(kOption, whole.substr(0, colon),
                            {{"boxes", Kind::boxes}, {"faces", Kind::faces}, {"springs", Kind::springs}});
    }

    bool has_number() const { return colon != std::string::npos; }
    double number(double usual, const Limit& limit) const {
        if (!has_number()) return usual;
        double value = 0.0;
        const char* end = text.data() + text.size();
        const auto [read, status] = std::from_chars(text.data() + colon + 1, end, value);
        if (status != std::errc() || read != end || !limit.holds(value))
            refuse(fmt::format("the number must be {}", limit.allowed));
        return value;
    }
    [[noreturn]] void refuse(const std::string& problem) const {
        throw InvalidInput({{}, 0, kOption, text, problem});
    }

    std::string text;
    std::size_t colon;
    Kind kind;
};

}  // namespace

Overlays parse_overlays(const std::vector<std::string>& texts) {
    Overlays overlays;
    for (const std::string& text : texts) {
        const Request request(text);
        switch (request.kind) {
            case Kind::boxes:
                overlays.box_levels = static_cast<int>(request.number(kUsualLevels, kLevels));
                break;
            case Kind::faces:
                if (request.has_number()) request.refuse("faces takes no number");
                overlays.faces = true;
                break;
            case Kind::springs:
                overlays.full_strain = static_cast<float>(request.number(kUsualStrain, kStrain));
                break;
        }
    }
    return overlays;
}

}  // namespace gelatin
