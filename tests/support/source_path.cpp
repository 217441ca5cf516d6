#include "support/source_path.h"

namespace gelatin::test {

std::string source_path(const std::string& below) {
    return std::string(GELATIN_SOURCE_DIR) + "/" + below;
}

}  // namespace gelatin::test
