#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "gelatin/export.h"

namespace gelatin {

/// Base of every exception that Gelatin throws on purpose; `what()` is one line for the user.
class GELATIN_API Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What is wrong with an input, and where. Empty strings and line 0 mean "does not apply".
struct InputProblem {
    std::string file;
    int line = 0;
    std::string field;    ///< dotted key, or the part of a mesh file ("vertex 12")
    std::string value;    ///< as the user wrote it
    std::string problem;  ///< what is wrong, and what is allowed
};

/// The input or the call is wrong (exit code 2).
class GELATIN_API InvalidInput : public Error {
public:
    explicit InvalidInput(InputProblem problem);
    explicit InvalidInput(const std::string& problem) : InvalidInput(InputProblem{{}, 0, {}, {}, problem}) {}

    const InputProblem& problem() const { return problem_; }

private:
    InputProblem problem_;
};

/// When and where a simulation diverged.
struct Divergence {
    std::uint64_t step = 0;  ///< the first step with an invalid state, counted from frame 0; 0: unknown
    int frame = 0;           ///< the frame that this step belongs to
    double time = 0.0;       ///< [s]
    std::string object;
    std::uint32_t node = 0;  ///< index in the object; undefined if the step is unknown
};

/// The simulation produced numbers that are not finite, or energy without a cause (exit code 3).
class GELATIN_API Diverged : public Error {
public:
    explicit Diverged(const std::string& message, Divergence where = {})
        : Error(message), where_(std::move(where)) {}

    const Divergence& where() const { return where_; }

private:
    Divergence where_;
};

/// OpenGL failed; contains the driver's messages (exit code 1).
class GELATIN_API GlError : public Error {
public:
    using Error::Error;
};

/// There is no OpenGL that Gelatin can use (exit code 4).
class GELATIN_API NoOpenGl : public GlError {
public:
    using GlError::GlError;
};

/// The operating system or a helper program failed: disk full, a program missing (exit code 1).
class GELATIN_API SystemError : public Error {
public:
    using Error::Error;
};

/// The caller has cancelled what was under way (Loading::cancel).
class GELATIN_API Cancelled : public Error {
public:
    using Error::Error;
};

}  // namespace gelatin
