#pragma once

#include <string>

namespace gelatin::test {

/// Of a file or folder of the project's sources, given by its path below their root.
std::string source_path(const std::string& below = {});

}  // namespace gelatin::test
