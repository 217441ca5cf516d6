#include "mesh/font_face.h"

#include "gelatin/error.h"
#include "mesh/find_font.h"

namespace gelatin {
namespace {

FT_Library start_freetype() {
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library) != 0) throw SystemError("FreeType cannot be started");
    return library;
}

}  // namespace

FontFace::FontFace(const std::string& font) : library_(start_freetype(), FT_Done_FreeType) {
    const FontFile found = find_font(font);
    FT_Face face = nullptr;
    if (FT_New_Face(library_.get(), found.file.c_str(), found.index, &face) != 0) {
        throw InvalidInput({found.file.string(), 0, {}, {}, "FreeType cannot read this as a font file"});
    }
    face_.reset(face);
    if (!FT_IS_SCALABLE(face)) {
        throw InvalidInput(
            {found.file.string(), 0, {}, {}, "this is a bitmap font; an outline font is needed"});
    }
}

}  // namespace gelatin
