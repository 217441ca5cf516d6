#include "mesh/tetrahedralise.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <sstream>

#include "core/file.h"
#include "gelatin/error.h"
#include "mesh/shapes.h"
#include "mesh/surface_repair.h"
#include "mesh/topology.h"
#include "mesh_samples.h"

namespace gelatin {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

// Gives each test an empty cache, and lets it put another `tetgen` in front of the true one.
class Tetrahedralise : public testing::Test {
public:
    Tetrahedralise() {
        fs::create_directory(cache_);
        fs::create_directory(programs_);
        ::setenv("GELATIN_CACHE_DIR", cache_.c_str(), 1);
    }
    ~Tetrahedralise() override {
        ::setenv("GELATIN_CACHE_DIR", old_cache_.c_str(), 1);
        ::setenv("PATH", old_path_.c_str(), 1);
    }

protected:
    // `script` is what `tetgen` does with a surface; asked for its version it gives another one each time.
    void replace_tetgen(const std::string& script) {
        const fs::path program = programs_ / "tetgen";
        write_file(program, "#!/bin/sh\nif [ \"$1\" = -h ]; then echo Version " + std::to_string(++version_) +
                                "; exit 0; fi\n" + script + "\n");
        fs::permissions(program, fs::perms::owner_all);
        ::setenv("PATH", (programs_.string() + ":" + old_path_).c_str(), 1);
    }

    std::size_t cache_entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(cache_), {}));
    }

    // The same that also counts how often it fills a surface.
    void replace_tetgen_and_count(const std::string& script) {
        replace_tetgen("case \"$1\" in -d*) exit 0;; esac; echo run >> " + log_.string() + "\n" + script);
    }
    std::ptrdiff_t runs() const {
        const std::string lines = read_file(log_);
        return std::count(lines.begin(), lines.end(), '\n');
    }

    int version_ = 0;
    const TemporaryFolder folder_;
    const fs::path log_ = folder_.path() / "log";
    const fs::path cache_ = folder_.path() / "cache", programs_ = folder_.path() / "programs";
    const std::string old_cache_ = environment("GELATIN_CACHE_DIR"), old_path_ = environment("PATH");
};

SurfaceMesh make_cube() {
    return make_box({});
}

MesherSettings with_max_volume(double volume) {
    MesherSettings settings;
    settings.max_volume = volume;
    return settings;
}

std::string message_of(const SurfaceMesh& surface, const MesherSettings& settings = {}) {
    try {
        tetrahedralise(surface, settings, "thing");
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "no error";
}

// The tets are the right way out, fill the surface, use every node, and their boundary is what `faces` says.
void expect_fills(const TetMesh& mesh, const SurfaceMesh& surface) {
    std::vector<bool> is_used(mesh.positions.size(), false);
    for (const glm::uvec4& tet : mesh.tets) {
        EXPECT_GT(tet_volume(mesh, tet), 0.0);
        for (int k = 0; k < 4; ++k) is_used.at(tet[k]) = true;
    }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
    const double volume = signed_volume(surface);
    EXPECT_NEAR(total_volume(mesh), volume, 1e-6 * volume);
    EXPECT_EQ(mesh.faces.size(), boundary_faces(mesh.tets).size());
    const SurfaceMesh boundary{mesh.positions, mesh.faces};
    EXPECT_TRUE(measure_openness(boundary).is_closed());
    EXPECT_NEAR(signed_volume(boundary), volume, 1e-6 * volume);
}

// Radius of the circumscribed sphere over the shortest edge.
double radius_edge_ratio(const TetMesh& mesh, const glm::uvec4& tet) {
    const glm::dvec3 a = mesh.positions[tet[0]];
    const glm::dvec3 b = mesh.positions[tet[1]] - a, c = mesh.positions[tet[2]] - a,
                     d = mesh.positions[tet[3]] - a;
    const glm::dvec3 center = (glm::dot(b, b) * glm::cross(c, d) + glm::dot(c, c) * glm::cross(d, b) +
                               glm::dot(d, d) * glm::cross(b, c)) /
                              (12.0 * tet_volume(mesh, tet));
    const double shortest = std::min({glm::length(b), glm::length(c), glm::length(d), glm::length(c - b),
                                      glm::length(d - b), glm::length(d - c)});
    return glm::length(center) / shortest;
}

TEST_F(Tetrahedralise, SphereHasTheCountsOfThePaper) {
    const SurfaceMesh sphere = make_sphere({0.5, 20});
    const TetMesh mesh = tetrahedralise(sphere, {}, "sphere");
    expect_fills(mesh, sphere);
    EXPECT_EQ(mesh.faces.size(), 8000u);
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), 4580.0, 50.0);
    EXPECT_NEAR(static_cast<double>(tet_edges(mesh.tets).size()), 22630.0, 250.0);
}

TEST_F(Tetrahedralise, KeepsQualityAndVolumeLimits) {
    const SurfaceMesh box = make_box({{1.0, 2.0, 0.5}, {1, 2, 1}});
    MesherSettings settings = with_max_volume(2e-3);
    settings.quality = 1.5;
    const TetMesh mesh = tetrahedralise(box, settings, "box");
    expect_fills(mesh, box);
    EXPECT_GT(mesh.tets.size(), 500u);
    for (const glm::uvec4& tet : mesh.tets) {
        EXPECT_LE(tet_volume(mesh, tet), 2e-3 * (1.0 + 1e-9));
        EXPECT_LE(radius_edge_ratio(mesh, tet), 1.5 * (1.0 + 1e-6));
    }
}

TEST_F(Tetrahedralise, TakesVerySmallAndVeryLargeThings) {
    for (const double size : {1e-4, 1e4}) {
        const SurfaceMesh box = make_box({glm::dvec3(size), glm::ivec3(2)});
        const TetMesh mesh = tetrahedralise(box, with_max_volume(0.01 * size * size * size), "box");
        expect_fills(mesh, box);
        EXPECT_GT(mesh.tets.size(), 100u);
        EXPECT_LT(mesh.tets.size(), 2000u);
    }
}

TEST_F(Tetrahedralise, FillsLetters) {
    for (const char letter : std::string("ABGELTIN8Si%")) {
        SCOPED_TRACE(letter);
        TextShape shape;
        shape.text = letter;
        const SurfaceMesh surface = make_text(shape);
        expect_fills(tetrahedralise(surface, with_max_volume(1e-4), "letter"), surface);
    }
}

void append_inward(SurfaceMesh& mesh, SurfaceMesh other) {
    for (glm::uvec3& face : other.faces) std::swap(face[1], face[2]);
    append(mesh, other);
}

TEST_F(Tetrahedralise, LeavesCavitiesEmpty) {
    for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(5e5, 4e6, 30.0)}) {
        SurfaceMesh shell = cube(place, 8.0);
        append_inward(shell, cube(place + 1.0, 6.0));
        append(shell, cube(place + 2.0, 1.0));  // a body in the cavity, out of its middle
        append_inward(shell, cube(place + 2.25, 0.5));
        const TetMesh mesh = tetrahedralise(shell, {}, "shell");
        expect_fills(mesh, shell);
        EXPECT_NEAR(total_volume(mesh), 512.0 - 216.0 + 1.0 - 0.125, 1e-4);
    }
    SurfaceMesh sponge = make_box({{4.0, 1.0, 1.0}, {8, 2, 2}});
    for (const double x : {-1.5, -0.5, 0.5, 1.5}) {
        SurfaceMesh ball = make_sphere({0.3, 3});
        for (glm::dvec3& p : ball.positions) p.x += x;
        append_inward(sponge, ball);
    }
    expect_fills(tetrahedralise(sponge, {}, "sponge"), sponge);
}

// The cavity touches the outside in one vertex.
TEST_F(Tetrahedralise, LeavesCavitiesEmptyThatTouch) {
    SurfaceMesh shell = cube({0, 0, 0}, 1.0);
    SurfaceMesh cavity = cube({0.25, 0.25, 0.25}, 0.5);
    cavity.positions[7] = {1, 1, 1};
    append_inward(shell, cavity);
    Notes notes;
    repair_surface(shell, notes);
    expect_fills(tetrahedralise(shell, {}, "shell"), shell);
}

TEST_F(Tetrahedralise, RefusesAResultThatFillsACavity) {
    // The last three lines of the surface are the number of holes, the hole, and the number of regions.
    const std::string holes =
        "head -n -3 surface.smesh > filled; printf '0\\n0\\n' >> filled; mv filled surface.smesh; ";
    replace_tetgen(holes + "PATH=" + old_path_ + " exec tetgen \"$@\"");
    SurfaceMesh shell = cube({0, 0, 0}, 1.0);
    append_inward(shell, cube({0.25, 0.25, 0.25}, 0.5));
    EXPECT_THAT(message_of(shell),
                HasSubstr("it fills 1 m^3, and the surface with its cavities encloses 0.875"));
}

TEST_F(Tetrahedralise, RunsTetgenOnceForTheSameInput) {
    replace_tetgen_and_count("PATH=" + old_path_ + " exec tetgen \"$@\"");
    const TetMesh first = tetrahedralise(make_cube(), {}, "cube");
    const TetMesh second = tetrahedralise(make_cube(), {}, "the same by another name");
    EXPECT_EQ(runs(), 1);
    EXPECT_EQ(first.positions, second.positions);
    EXPECT_EQ(first.tets, second.tets);
    EXPECT_EQ(first.faces, second.faces);

    MesherSettings better;
    better.quality = 1.4;
    tetrahedralise(make_cube(), better, "cube");
    tetrahedralise(make_cube(), with_max_volume(0.01), "cube");
    SurfaceMesh moved = make_cube();
    for (glm::dvec3& position : moved.positions) position.x = std::nextafter(position.x, 1.0);
    tetrahedralise(moved, {}, "cube");
    EXPECT_EQ(runs(), 4);
    EXPECT_EQ(cache_entries(), 4u);
}

TEST_F(Tetrahedralise, CountsTheEdgesOfAnOpenSurface) {
    SurfaceMesh open = make_cube();
    open.faces.pop_back();
    EXPECT_THAT(message_of(open),
                AllOf(HasSubstr("thing"), HasSubstr("not closed"), HasSubstr("3 edges have one face")));
    EXPECT_THAT(message_of({}), HasSubstr("no faces"));
}

TEST_F(Tetrahedralise, TellsThatASurfaceCrossesItself) {
    SurfaceMesh two = make_cube();
    const auto first = static_cast<std::uint32_t>(two.positions.size());
    for (const glm::dvec3& position : make_cube().positions) two.positions.push_back(0.9 * position + 0.31);
    for (const glm::uvec3& face : make_cube().faces) two.faces.push_back(face + first);
    EXPECT_THAT(message_of(two),
                AllOf(HasSubstr("crosses itself"), HasSubstr("36 pairs of intersecting faces")));
    EXPECT_THAT(message_of(two), AllOf(HasSubstr("crosses itself"), HasSubstr("from an earlier run")));
}

TEST_F(Tetrahedralise, PassesOnTheLastWordsOfACrash) {
    replace_tetgen("echo Opening.; echo Working hard.; echo \"terminate called\" >&2; kill -ABRT $$");
    EXPECT_THAT(message_of(make_cube()),
                AllOf(HasSubstr("thing"), HasSubstr("signal 6"), HasSubstr("Opening. / Working hard.")));
    replace_tetgen("echo Sorry; exit 3");
    EXPECT_THAT(message_of(make_cube()), AllOf(HasSubstr("exit code 3"), HasSubstr("Sorry")));
    replace_tetgen("exit 0");  // success without a result
    EXPECT_THAT(message_of(make_cube()), HasSubstr("TetGen cannot fill"));
}

TEST_F(Tetrahedralise, RefusesAResultThatMakesNoSense) {
    replace_tetgen(
        "printf '1 4 0\\n0 0 1 2 9\\n' > surface.1.ele; printf '1 3 0 0\\n0 0 0 0\\n' > surface.1.node");
    EXPECT_THAT(message_of(make_cube()), AllOf(HasSubstr("thing"), HasSubstr("cannot be used")));
}

// Two tets and a flat one below them: the flat one goes, and an inner one is refused.
TEST_F(Tetrahedralise, DropsFlatTetsFromTheBoundaryOnly) {
    const std::string nodes =
        "printf '6 3 0 0\\n0 0 0 0\\n1 1 0 0\\n2 1 1 0\\n3 0 1 0\\n4 .5 .5 1\\n5 .5 .5 -1\\n' > "
        "surface.1.node;";
    replace_tetgen(nodes +
                   "printf '4 4 0\\n0 0 1 2 4\\n1 0 1 2 3\\n2 0 2 3 4\\n3 0 1 5 4\\n' > surface.1.ele");
    EXPECT_EQ(tetrahedralise(make_cube(), {}, "thing").tets.size(), 3u);
    replace_tetgen(
        nodes +
        "printf '5 4 0\\n0 0 1 2 4\\n1 0 1 2 3\\n2 0 2 3 4\\n3 0 1 3 5\\n4 1 2 3 5\\n' > surface.1.ele");
    EXPECT_THAT(message_of(make_cube(), with_max_volume(1.0)), HasSubstr("1 of its tets are flat"));
}

TEST_F(Tetrahedralise, StopsAtTheTimeLimitAndNamesIt) {
    replace_tetgen("echo Still here.; sleep 60");
    MesherSettings settings;
    settings.time_limit = 0.3;
    EXPECT_THAT(message_of(make_cube(), settings),
                AllOf(HasSubstr("mesher.time_limit = 0.3 s"), HasSubstr("Still here."), HasSubstr("raise")));
}

// Were a failure forgotten, a surface on which TetGen takes too long would delay each run.
TEST_F(Tetrahedralise, RemembersThatTimeRanOutAndTriesAgainWithMore) {
    replace_tetgen_and_count("echo Still here.; sleep 60");
    MesherSettings settings;
    settings.time_limit = 0.3;
    const std::string first = message_of(make_cube(), settings);
    EXPECT_THAT(first, HasSubstr("mesher.time_limit = 0.3 s"));
    EXPECT_EQ(message_of(make_cube(), settings), first + "; this is known from an earlier run");
    settings.time_limit = 0.2;
    EXPECT_THAT(message_of(make_cube(), settings), HasSubstr("mesher.time_limit = 0.3 s"));
    EXPECT_EQ(runs(), 1);
    settings.time_limit = 0.4;
    EXPECT_THAT(message_of(make_cube(), settings), HasSubstr("mesher.time_limit = 0.4 s"));
    EXPECT_EQ(runs(), 2);
    settings.time_limit = 0.35;  // the longer one replaced the shorter
    EXPECT_THAT(message_of(make_cube(), settings), HasSubstr("0.4 s"));
    settings.quality = 1.5;  // another question
    EXPECT_THAT(message_of(make_cube(), settings), HasSubstr("0.35 s"));
    EXPECT_EQ(runs(), 3);
}

TEST_F(Tetrahedralise, ATryWithMoreTimeMaySucceed) {
    replace_tetgen_and_count("[ -e " + (folder_.path() / "go").string() +
                             " ] || sleep 60\nPATH=" + old_path_ + " exec tetgen \"$@\"");
    MesherSettings settings;
    settings.time_limit = 0.3;
    EXPECT_THAT(message_of(make_cube(), settings), HasSubstr("0.3 s"));
    write_file(folder_.path() / "go", "");
    settings.time_limit = 30.0;
    EXPECT_EQ(message_of(make_cube(), settings), "no error");
    settings.time_limit = 0.1;  // now there are tets
    EXPECT_EQ(message_of(make_cube(), settings), "no error");
    EXPECT_EQ(runs(), 2);
}

TEST_F(Tetrahedralise, RemembersFailuresOfTetgenButNotOfTheSystem) {
    MesherSettings patient;
    patient.time_limit = 1e6;
    replace_tetgen_and_count("echo Sorry; exit 3");
    const std::string first = message_of(make_cube());
    EXPECT_EQ(message_of(make_cube(), patient), first + "; this is known from an earlier run");
    EXPECT_EQ(runs(), 1);
    for (const char* script : {"kill -KILL $$", "kill -TERM $$", "echo Error:  Out of memory.; exit 1"}) {
        replace_tetgen_and_count(script);
        const auto before = runs();
        const std::size_t entries = cache_entries();
        message_of(make_cube());
        EXPECT_THAT(message_of(make_cube()), testing::Not(HasSubstr("earlier run")));
        EXPECT_EQ(runs(), before + 2) << script;
        EXPECT_EQ(cache_entries(), entries);
    }
}

TEST_F(Tetrahedralise, RefusesAVolumeThatAsksForTooMany) {
    EXPECT_THAT(message_of(make_cube(), with_max_volume(1e-12)), HasSubstr("mesher.max_volume"));
}

TEST_F(Tetrahedralise, SaysThatThereIsNoTetgen) {
    std::istringstream folders(old_path_);
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (fs::exists(fs::path(folder) / "stdbuf")) {
            fs::create_symlink(fs::path(folder) / "stdbuf", programs_ / "stdbuf");
            break;
        }
    }
    ::setenv("PATH", programs_.c_str(), 1);
    try {
        tetrahedralise(make_cube(), {}, "cube");
        FAIL() << "no error";
    } catch (const SystemError& error) {
        EXPECT_THAT(error.what(), HasSubstr("tetgen: no such program"));
    }
}

}  // namespace
}  // namespace gelatin
