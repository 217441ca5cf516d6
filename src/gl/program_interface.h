#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gl/object_name.h"

namespace gelatin::gl {

/// What a linked program takes from outside, found by name: uniforms, storage blocks, samplers and vertex
/// inputs; and the resources that are bound to these. Blocks have a binding point each and samplers a
/// texture unit each, numbered from 0 within the program.
///
/// Internal to this layer: Program is its interface.
class ProgramInterface {
public:
    struct Uniform {
        std::string name;
        int location;
    };
    struct Block {
        std::string name;
        unsigned index;  // of its binding point
        ObjectName buffer = nullptr;
    };
    struct Sampler {
        std::string name;
        unsigned unit;
        unsigned target;  // GL_TEXTURE_2D, for example
        ObjectName texture = nullptr;
        unsigned texture_id = 0;  // where there is no `texture`
        unsigned sampler_id = 0;  // a sampler object; 0: the texture's own parameters

        unsigned id() const { return texture != nullptr ? *texture : texture_id; }
    };
    struct Input {
        std::string name;
        unsigned location;
        ObjectName buffer = nullptr;
        bool is_color = false;  // four bytes that stand for 0 to 1, else four floats
    };

    ProgramInterface() = default;
    /// Reflects `program`. @param source the text of all its shaders, includes expanded
    ProgramInterface(unsigned program, std::string source);

    /// Null where the program does not use the name.
    const Uniform* find_uniform(std::string_view name) const;
    Block* find_block(std::string_view name);
    Sampler* find_sampler(std::string_view name);
    Input* find_input(std::string_view name);

    const std::vector<Uniform>& uniforms() const { return uniforms_; }
    const std::vector<Block>& blocks() const { return blocks_; }
    const std::vector<Sampler>& samplers() const { return samplers_; }
    const std::vector<Input>& inputs() const { return inputs_; }

    /// "storage block Positions" for the first of which nothing, or something deleted, is bound to; empty
    /// where all have a resource.
    std::string unbound() const;

    /// True if the source has `name` as a word, whether the linker kept it or not; always true in release
    /// builds, which do not keep the source.
    bool declares(std::string_view name) const;

private:
    void reflect_uniforms(unsigned program);
    void reflect_blocks(unsigned program);
    void reflect_inputs(unsigned program);

    std::vector<Uniform> uniforms_;  // these four in the order of their names
    std::vector<Block> blocks_;
    std::vector<Sampler> samplers_;
    std::vector<Input> inputs_;
    std::string source_;
};

}  // namespace gelatin::gl
