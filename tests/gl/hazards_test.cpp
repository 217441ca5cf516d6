#include "gl/hazards.h"

#include <epoxy/gl.h>
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "core/current_stage.h"
#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/readback.h"
#include "support/gl_fixture.h"
#include "support/shader_folder.h"

namespace gelatin::gl {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// What the tracker sees of the calls of this layer, on shaders that hardly do anything.
class HazardsTest : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        folder_.add("write.comp",
                    "layout(local_size_x = 64) in;\n"
                    "layout(std430) writeonly buffer Out { uint values[]; };\n"
                    "void main() { values[gl_GlobalInvocationID.x] = 1u; }\n");
        folder_.add("read.comp",
                    "layout(local_size_x = 64) in;\n"
                    "layout(std430) readonly buffer In { uint values[]; };\n"
                    "layout(std430) writeonly buffer Copy { uint copies[]; };\n"
                    "void main() { copies[gl_GlobalInvocationID.x] = values[gl_GlobalInvocationID.x]; }\n");
        folder_.add(
            "fetch.comp",
            "layout(local_size_x = 64) in;\n"
            "uniform usamplerBuffer texels;\n"
            "layout(std430) writeonly buffer Copy { uint copies[]; };\n"
            "void main() { uint i = gl_GlobalInvocationID.x; copies[i] = texelFetch(texels, int(i)).x; }\n");
        write_ = Program::compute("write.comp");
        write_.bind("Out", buffer_);
    }

    void write() { write_.dispatch(64); }
    Program reader() {
        Program read = Program::compute("read.comp");
        read.bind("In", buffer_);
        read.bind("Copy", copy_);
        return read;
    }

    test::ShaderFolder folder_;
    Buffer<std::uint32_t> buffer_{64}, copy_{64};
    Program write_;
};

TEST_F(HazardsTest, ABlockIsReadBehindAStorageBarrier) {
    const Program read = reader();
    write();
    barrier(Barrier::texture_fetch);
    read.dispatch(64);
    EXPECT_THAT(take_hazards(), ElementsAre(AllOf(HasSubstr("read.comp reads block In"),
                                                  HasSubstr("write.comp wrote as block Out"),
                                                  HasSubstr("no barrier(storage)"))));
    barrier(Barrier::storage);
    read.dispatch(64);
    EXPECT_THAT(take_hazards(), IsEmpty());
}

TEST_F(HazardsTest, ABlockThatIsReadOnlyIsNotWritten) {
    const Program read = reader();
    buffer_.fill(1);
    read.dispatch(64);
    barrier(Barrier::texture_fetch);
    Program fetch = Program::compute("fetch.comp");
    const BufferTexture texels(buffer_, TexelFormat::r32ui);
    Buffer<std::uint32_t> other(64);
    fetch.bind("texels", texels);
    fetch.bind("Copy", other);
    fetch.dispatch(64);
    EXPECT_THAT(take_hazards(), IsEmpty());
}

TEST_F(HazardsTest, AStoreWaitsForEarlierReads) {
    const Program read = reader();
    buffer_.fill(1);
    read.dispatch(64);
    write();
    EXPECT_THAT(take_hazards(), ElementsAre(HasSubstr("write.comp overwrites block Out")));
    barrier(Barrier::storage);
    write();
    EXPECT_THAT(take_hazards(), IsEmpty());
}

TEST_F(HazardsTest, TexelsAreFetchedBehindATextureBarrier) {
    Program fetch = Program::compute("fetch.comp");
    const BufferTexture texels(buffer_, TexelFormat::r32ui);
    fetch.bind("texels", texels);
    fetch.bind("Copy", copy_);
    write();
    barrier(Barrier::storage);
    fetch.dispatch(64);
    EXPECT_THAT(take_hazards(), ElementsAre(AllOf(HasSubstr("fetch.comp reads samplerBuffer texels"),
                                                  HasSubstr("no barrier(texture_fetch)"))));
}

TEST_F(HazardsTest, IndirectArgumentsAreReadBehindACommandBarrier) {
    const Program read = reader();
    const std::vector<std::uint32_t> one_group = {1, 1, 1};
    Buffer<std::uint32_t> arguments{std::span<const std::uint32_t>(one_group)};
    read.dispatch_indirect(arguments.id(), 0);
    EXPECT_THAT(take_hazards(), IsEmpty());
    Buffer<std::uint32_t> written(64);
    written.fill(1);
    write_.bind("Out", written);
    write();
    barrier(Barrier::storage);
    read.dispatch_indirect(written.id(), 0);
    EXPECT_THAT(take_hazards(), ElementsAre(AllOf(HasSubstr("read.comp reads indirect arguments"),
                                                  HasSubstr("no barrier(command)"))));
}

TEST_F(HazardsTest, TransfersNeedABufferBarrier) {
    std::vector<std::uint32_t> values(64);
    write();
    barrier(Barrier::storage);
    buffer_.download(values);
    EXPECT_THAT(take_hazards(), ElementsAre(HasSubstr("a download reads its source")));
    buffer_.fill(0);
    EXPECT_THAT(take_hazards(), ElementsAre(HasSubstr("a clear overwrites its target")));
    barrier(Barrier::storage);
    write();
    buffer_.upload(values);
    EXPECT_THAT(take_hazards(), ElementsAre(HasSubstr("an upload overwrites its target")));
    barrier(Barrier::storage);
    write();
    barrier(Barrier::buffer_update);
    buffer_.download(values);
    EXPECT_THAT(take_hazards(), IsEmpty());
}

TEST_F(HazardsTest, AReadbackHasABarrierOfItsOwn) {
    Readback readback;
    write();
    barrier(Barrier::storage);
    readback.begin(buffer_.id(), 64);
    EXPECT_THAT(take_hazards(), IsEmpty());
    write();
    EXPECT_THAT(take_hazards(),
                Contains(AllOf(HasSubstr("write.comp overwrites"), HasSubstr("a copy reads"))));
}

TEST_F(HazardsTest, VerticesAndIndicesAreFetchedBehindAVertexBarrier) {
    folder_.add("points.vert",
                "layout(location = 0) in vec4 place;\n"
                "void main() { gl_Position = place; gl_PointSize = 1.0; }\n");
    folder_.add("points.frag", "out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
    Program draw = Program::graphics("points.vert", "points.frag");
    Buffer<glm::vec4> places(64);
    draw.bind_input("place", places);
    Program write_places = Program::compute("write.comp");
    write_places.bind("Out", places);

    GLuint vertex_array = 0, framebuffer = 0, color = 0;
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenRenderbuffers(1, &color);
    glBindRenderbuffer(GL_RENDERBUFFER, color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 4, 4);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);

    write_places.dispatch(64);
    write();
    barrier(Barrier::storage);
    draw.draw_arrays(Primitive::points, 4);
    EXPECT_THAT(take_hazards(),
                ElementsAre(AllOf(HasSubstr("points.vert with points.frag reads vertex attribute"),
                                  HasSubstr("no barrier(vertex_pull)"))));
    draw.draw_elements(Primitive::points, buffer_.id(), 4);
    EXPECT_THAT(take_hazards(),
                Contains(AllOf(HasSubstr("reads indices"), HasSubstr("no barrier(vertex_pull)"))));
    barrier(Barrier::vertex_pull);
    draw.draw_elements(Primitive::points, buffer_.id(), 4);
    EXPECT_THAT(take_hazards(), IsEmpty());

    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glBindVertexArray(0);
    glDeleteFramebuffers(1, &framebuffer);
    glDeleteRenderbuffers(1, &color);
    glDeleteVertexArrays(1, &vertex_array);
}

TEST_F(HazardsTest, ReportsNameTheStage) {
    const Program read = reader();
    write();
    {
        const CurrentStage stage("update_boxes");
        read.dispatch(64);
    }
    EXPECT_THAT(take_hazards(), ElementsAre(HasSubstr("read.comp (update_boxes) reads")));
}

TEST_F(HazardsTest, ANewBufferHasNoPast) {
    const Program read = reader();
    write();
    buffer_ = Buffer<std::uint32_t>(64);  // may well have the same name
    read.bind("In", buffer_);
    read.dispatch(64);
    EXPECT_THAT(take_hazards(), IsEmpty());
}

TEST_F(HazardsTest, BarriersThatNothingNeededAreListed) {
    const Program read = reader();
    write();
    const int needed = __LINE__ + 1;
    barrier(Barrier::storage);
    const int partly = __LINE__ + 1;
    barrier(Barrier::texture_fetch | Barrier::command);
    read.dispatch(64);
    const auto at = [](int line) { return HasSubstr("hazards_test.cpp:" + std::to_string(line) + ":"); };
    EXPECT_THAT(unneeded_barriers(), Not(Contains(at(needed))));
    EXPECT_THAT(unneeded_barriers(),
                Contains(AllOf(at(partly), HasSubstr("is not needed for texture_fetch | command"))));
}

}  // namespace
}  // namespace gelatin::gl
