#pragma once

#include <string_view>
#include <vector>

namespace gelatin::gl {

struct EmbeddedShader {
    std::string_view name;  ///< path below shaders/, e.g. "sim/explicit/advance_nodes.comp"
    std::string_view text;
};

/// Every file under shaders/ as it was at build time.
const std::vector<EmbeddedShader>& embedded_shaders();

}  // namespace gelatin::gl
