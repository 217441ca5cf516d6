#pragma once

#include <toml++/toml.h>

#include <string>

namespace gelatin {

/// Sets one value of a parsed scene file: "simulation.solver=rk4", "object.ball.velocity=[0, 1, 0]". Elements
/// of a list of tables go by their name or their index. What does not read as a TOML value is taken as a
/// string if it is a bare word, such as a name or a path. The new nodes' source is "--set TEXT", for
/// messages.
/// @throws InvalidInput if it is not "key=value", or the key leads through something that is not there or not
/// a table.
void apply_override(toml::table& scene, const std::string& text);

}  // namespace gelatin
