// Compiled twice: as GLSL and as C++ (src/model/shared_constants.h).
// What decides between cases of forces, shapes and contacts. Each is explained where the CPU twin uses it.
const float kFlattest = 0.5;          // volume over that at rest, below which a tet is flat
const float kCollapsed = 0.03;        // of I, the sum of squares of F: below it a neo-Hookean tet is nearly a point
const float kLeastExplained = 0.75;   // share of a body's extent that an affine map explains, if it has its shape
const float kThinnest = 0.001;        // of an affine map: s1^2 s2^2 + ... over (s1^2 + ...)^2, of its singular values
const float kPatience = 0.5;          // for how long a body may seem to have lost its shape, as it may where it is crushed [s]
const float kAcross = 0.25;           // |n . n'|, below which two faces are nearly perpendicular
const float kWeightOfOthers = 1e-3;   // in a contact's normal, of faces that do not enter
