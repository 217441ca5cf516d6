#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gelatin::test {

/// Drags files onto the window whose name has `title` in it and drops them, as a file manager does (the XDND
/// protocol, version 5). Waits for the window's answers: on another thread than the one that draws.
/// @return what went wrong; empty if nothing
std::string drop_files(const std::string& title, const std::vector<std::filesystem::path>& files);

}  // namespace gelatin::test
