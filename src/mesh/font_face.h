#pragma once

#include <ft2build.h>

#include <memory>
#include <string>

#include FT_FREETYPE_H

namespace gelatin {

/// A face of an installed font, opened with FreeType. Move-only.
class FontFace {
public:
    /// @param font as find_font takes it
    /// @throws InvalidInput if there is no such font, or it has no outlines; SystemError if FreeType fails
    explicit FontFace(const std::string& font);

    FT_Face get() const { return face_.get(); }

private:
    std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> library_;  // outlives the face
    std::unique_ptr<FT_FaceRec_, decltype(&FT_Done_Face)> face_{nullptr, FT_Done_Face};
};

}  // namespace gelatin
