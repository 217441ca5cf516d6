#include "mesh/find_font.h"

#include <fontconfig/fontconfig.h>

#include <algorithm>
#include <iterator>
#include <memory>

#include "gelatin/error.h"

namespace gelatin {

namespace {

using Pattern = std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)>;

const FcChar8* fc_string(const char* text) {
    return reinterpret_cast<const FcChar8*>(text);
}

[[noreturn]] void refuse(const std::string& font, const std::string& problem) {
    throw InvalidInput({{}, 0, "font", "\"" + font + "\"", problem});
}

const FcChar8* family_of(const Pattern& pattern, int n) {
    FcChar8* family = nullptr;
    return FcPatternGetString(pattern.get(), FC_FAMILY, n, &family) == FcResultMatch ? family : nullptr;
}

/// Generic names, which stand for any font of a kind.
bool is_generic(const FcChar8* family) {
    const char* generic[] = {"sans", "sans-serif", "serif",   "monospace",
                             "mono", "cursive",    "fantasy", "system-ui"};
    return std::any_of(std::begin(generic), std::end(generic),
                       [&](const char* name) { return FcStrCmpIgnoreCase(family, fc_string(name)) == 0; });
}

/// True if `found` belongs to one of the families that `wanted` names, or if `wanted` names none.
bool has_wanted_family(const Pattern& wanted, const Pattern& found) {
    if (family_of(wanted, 0) == nullptr) return true;
    for (int w = 0; const FcChar8* wanted_family = family_of(wanted, w); ++w) {
        if (is_generic(wanted_family)) return true;
        for (int f = 0; const FcChar8* found_family = family_of(found, f); ++f) {
            if (FcStrCmpIgnoreCase(wanted_family, found_family) == 0) return true;
        }
    }
    return false;
}

}  // namespace

FontFile find_font(const std::string& font) {
    std::error_code error;
    if (std::filesystem::is_regular_file(font, error)) return {font, 0};
    if (font.find('/') != std::string::npos) refuse(font, "no such font file");

    const Pattern wanted(FcNameParse(fc_string(font.c_str())), FcPatternDestroy);
    if (!wanted) refuse(font, "is neither a font file nor a fontconfig pattern such as \"DejaVu Sans:bold\"");
    FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
    const Pattern query(FcPatternDuplicate(wanted.get()), FcPatternDestroy);
    FcConfigSubstitute(nullptr, query.get(), FcMatchPattern);
    FcDefaultSubstitute(query.get());

    FcResult result = FcResultNoMatch;
    const Pattern found(FcFontMatch(nullptr, query.get(), &result), FcPatternDestroy);
    FcChar8* file = nullptr;
    if (!found || !has_wanted_family(wanted, found) ||
        FcPatternGetString(found.get(), FC_FILE, 0, &file) != FcResultMatch) {
        refuse(font,
               "this font is not installed; install it, or name another one (fc-list shows those installed)");
    }
    FontFile face{reinterpret_cast<const char*>(file), 0};
    FcPatternGetInteger(found.get(), FC_INDEX, 0, &face.index);
    face.index &= 0xffff;  // the upper half selects an instance of a variable font
    return face;
}

}  // namespace gelatin
