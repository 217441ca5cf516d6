#pragma once

namespace gelatin::python {

/// Has Gelatin's exceptions become those of python/gelatin/errors.py, with their text and what else they
/// contain.
void translate_errors();

}  // namespace gelatin::python
