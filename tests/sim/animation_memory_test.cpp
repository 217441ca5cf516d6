#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/file_writer.h"
#include "gelatin/error.h"
#include "sim/animation/animation_file.h"
#include "sim/simulator_internals.h"

#ifdef GELATIN_COUNTS_MEMORY
namespace {

// What this program has from `new` now, and the most that it had.
std::atomic<std::size_t> held{0}, most{0};

void* take(std::size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t now = held += malloc_usable_size(memory);
    std::size_t before = most;
    while (before < now && !most.compare_exchange_weak(before, now)) {
    }
    return memory;
}

void give_back(void* memory) noexcept {
    held -= malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
    return take(size);
}
void* operator new[](std::size_t size) {
    return take(size);
}
void operator delete(void* memory) noexcept {
    give_back(memory);
}
void operator delete[](void* memory) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
    give_back(memory);
}
void operator delete[](void* memory, std::size_t /*size*/) noexcept {
    give_back(memory);
}
#endif

namespace gelatin {
namespace {

namespace fs = std::filesystem;

Scene one_ball() {
    Scene scene;
    scene.materials.emplace_back().name = "jelly";
    ObjectDescription ball;
    ball.name = "ball";
    ball.shape = SphereShape{0.5, 20};
    ball.material = "jelly";
    ball.mesher.kind = MesherKind::lattice;
    ball.mesher.nodes = 1000;
    scene.objects.push_back(ball);
    return scene;
}

class AnimationMemoryTest : public testing::TestWithParam<std::string> {
protected:
    static SimulatorOptions on_cpu() {
        SimulatorOptions options;
        options.backend = Backend::cpu;
        return options;
    }

    std::unique_ptr<AnimationFile> begin() const {
        return make_animation_file(folder_.path() / ("ball" + GetParam()), model_of(simulator_),
                                   {60.0, {glm::vec3(0.5f)}});
    }

    static void write(AnimationFile& file, HostFrame frame, int count) {
        for (frame.frame = 0; frame.frame < count; ++frame.frame) {
            for (float& x : frame.positions) x += 0.001f;
            file.write(frame);
        }
    }

#ifdef GELATIN_COUNTS_MEMORY
    // Bytes, at most at once, for a file of so many frames.
    std::size_t needed(int frames) const {
        const HostFrame frame = simulator_.read_frame();
        const std::size_t before = held;
        most = before;
        const auto file = begin();
        write(*file, frame, frames);
        file->finish();
        return most - before;
    }
#endif

    std::vector<fs::path> files() const {
        return {fs::directory_iterator(folder_.path()), fs::directory_iterator()};
    }

    TemporaryFolder folder_;
    Simulator simulator_{one_ball(), on_cpu()};
};

#ifdef GELATIN_COUNTS_MEMORY
// Of glTF, a few kilobytes a frame are: what its JSON says of each.
TEST_P(AnimationMemoryTest, DoesNotGrowWithTheFrames) {
    const std::size_t frame = 12 * std::size_t{model_of(simulator_).skin.points.size()};
    ASSERT_GT(frame, 40'000u);
    const std::size_t few = needed(60), many = needed(160);
    EXPECT_LT(many, few + 12 * frame) << "with " << frame << " bytes a frame";
}
#endif

// As if the process was killed before the end: neither under its name nor under another one.
TEST_P(AnimationMemoryTest, NothingIsThereBeforeItIsWhole) {
    const auto file = begin();
    write(*file, simulator_.read_frame(), 5);
    EXPECT_TRUE(files().empty());
    file->finish();
    ASSERT_EQ(files().size(), 1u);
    EXPECT_EQ(files()[0].filename(), "ball" + GetParam());
}

TEST_P(AnimationMemoryTest, AFullDiskIsAnError) {
    fs::create_symlink("/dev/full", folder_.path() / ("ball" + GetParam()));
    const auto file = begin();
    write(*file, simulator_.read_frame(), 2);
    EXPECT_THROW(file->finish(), SystemError);
}

INSTANTIATE_TEST_SUITE_P(Formats, AnimationMemoryTest, testing::ValuesIn(animation_endings()),
                         [](const auto& given) { return given.param.substr(1); });

TEST(FileWriter, WhatIsNotFinishedIsRemoved) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "name";
    write_file(file, "before");
    {
        FileWriter writer(file);
        writer.append("after");
        EXPECT_EQ(read_file(file), "before");
    }
    EXPECT_EQ(read_file(file), "before");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
    FileWriter writer(file);
    const std::string piece(700'000, 'x');
    for (int k = 0; k < 5; ++k) writer.append(piece);
    writer.finish();
    EXPECT_EQ(read_file(file), piece + piece + piece + piece + piece);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

TEST(ScratchFile, HasWhatWasAppendedAndNoName) {
    const TemporaryFolder folder;
    ScratchFile scratch(folder.path());
    scratch.append("01234", 5);
    scratch.append("56789", 5);
    EXPECT_EQ(scratch.size(), 10u);
    std::string read(4, ' ');
    scratch.read(3, read.data(), read.size());
    EXPECT_EQ(read, "3456");
    EXPECT_TRUE(fs::is_empty(folder.path()));
    EXPECT_THROW(ScratchFile(folder.path() / "none"), SystemError);
}

}  // namespace
}  // namespace gelatin
