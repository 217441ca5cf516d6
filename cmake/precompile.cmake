# gelatin_precompile(TARGET)
#
# Compiles the headers that most sources include once, for all static libraries: they take more than half of the time of
# most sources. scripts/check_tidy reads sources without them, and so finds those that do not include what they use.
# fmt/core.h, not fmt/format.h: with the latter GCC compiles all of the formatting again in each source, for 2 seconds.
set(gelatin_common_headers
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional>
    <span> <string> <utility> <vector> <fmt/core.h> <glm/geometric.hpp> <glm/glm.hpp>)

function(gelatin_precompile target)
    if(NOT PROJECT_IS_TOP_LEVEL)
        return()  # a project around this one may forbid them, or have its own
    endif()
    if(target STREQUAL gelatin_core)
        target_precompile_headers(gelatin_core PRIVATE ${gelatin_common_headers})
    else()
        target_precompile_headers(${target} REUSE_FROM gelatin_core)
    endif()
endfunction()
