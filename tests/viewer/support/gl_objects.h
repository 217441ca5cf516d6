#pragma once

#include <map>
#include <string>

namespace gelatin::test {

/// How many objects of each kind there are in the current context. Fences, which have no numbers, are counted
/// from the first call on, as they are made and deleted.
std::map<std::string, int> count_gl_objects();

}  // namespace gelatin::test
