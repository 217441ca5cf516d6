#pragma once

#include <string>
#include <vector>

namespace gelatin::gl {

/// GLSL text ready for the driver, and the file each `#line` source number stands for.
struct ShaderSource {
    std::string text;
    std::vector<std::string> files;  ///< files[n] is source string number n

    /// Rewrites positions such as "2:14(3): error" (Mesa), "2(14) : error" (NVIDIA) or "ERROR: 2:14" (others)
    /// in a driver's log so that they name the file.
    std::string translate_log(const std::string& log) const;
};

/// The text of `file`, a path below shaders/: that of a ShaderOverride, else from GELATIN_SHADER_DIR if set,
/// else as embedded.
/// @throws GlError if there is no such file.
std::string shader_text(const std::string& file);

/// Where GELATIN_DUMP_SHADERS names a folder, writes the text there, as other compilers take it:
/// "sim/view/mark_faces.comp" becomes "sim_view_mark_faces-HASH.comp", one for each set of defines.
/// @throws GlError if that fails.
void dump_shader(const std::string& file, const ShaderSource& source);

/// Loads `file` as shader_text does, puts "#version 430 core" and the defines before it, and expands
/// `#include "path"` (relative to shaders/, once each).
/// @throws GlError if a file is missing or includes go round in a circle, naming the including file and line.
ShaderSource load_shader(const std::string& file, const std::vector<std::string>& defines = {});

/// Replaces the text of one file below shaders/, or adds a file, for as long as the object lives: tests make
/// and break shaders with it. At most one for each file; no other thread may load shaders while one is made
/// or ends.
class ShaderOverride {
public:
    ShaderOverride(std::string file, std::string text);
    ShaderOverride(const ShaderOverride&) = delete;
    ShaderOverride& operator=(const ShaderOverride&) = delete;
    ~ShaderOverride();

private:
    std::string file_;
};

}  // namespace gelatin::gl
