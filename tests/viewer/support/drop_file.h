#pragma once

#include <filesystem>
#include <string>

namespace gelatin::test {

/// Drags a file onto the window whose name has `title` in it and drops it, as a file manager does (the XDND
/// protocol, version 5). Waits for the window's answers: on another thread than the one that draws.
/// @return what went wrong; empty if nothing
std::string drop_file(const std::string& title, const std::filesystem::path& file);

}  // namespace gelatin::test
