#include "gl/hazard_tracker.h"

#include <gmock/gmock.h>

namespace gelatin::gl {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr unsigned kBuffer = 7;

// The rules of the tracker, one by one, on commands that nobody runs.
class HazardTrackerTest : public ::testing::Test {
protected:
    void shader(const char* name, const BufferAccess& access) {
        tracker_.apply(GpuCommand{GpuCommand::Kind::shader, name, "some_stage", false, {access}});
    }
    void store(unsigned buffer = kBuffer) {
        shader("writer.comp", {buffer, Barrier::storage, false, true, "block Out"});
    }
    void read(Barrier use, unsigned buffer = kBuffer) {
        shader("reader.comp", {buffer, use, true, false, "block In"});
    }
    void transfer(const BufferAccess& access, bool replaces_all = false) {
        tracker_.apply(GpuCommand{GpuCommand::Kind::transfer, "transfer", "", replaces_all, {access}});
    }
    void barrier(Barrier bits, int line = 1) { tracker_.apply(BarrierCall{bits, {"src/a.cpp", line}}); }

    std::vector<std::string> hazards() { return tracker_.take_hazards(); }

    HazardTracker tracker_;
};

constexpr Barrier kAllUses[] = {Barrier::storage,       Barrier::texture_fetch, Barrier::vertex_pull,
                                Barrier::buffer_update, Barrier::command,       Barrier::pixel_unpack};

TEST_F(HazardTrackerTest, AReadNeedsTheBarrierOfItsUseAfterAStore) {
    for (const Barrier use : kAllUses) {
        for (const Barrier between : {Barrier::none, use}) {
            tracker_.apply(BufferReset{kBuffer});
            store();
            barrier(between);
            read(use);
            EXPECT_THAT(hazards(), SizeIs(between == use ? 0 : 1)) << to_string(use);
        }
    }
}

TEST_F(HazardTrackerTest, ABarrierOfAnotherUseDoesNotHelp) {
    for (const Barrier use : kAllUses) {
        for (const Barrier other : kAllUses) {
            if (use == other) continue;
            tracker_.apply(BufferReset{kBuffer});
            store();
            barrier(other);
            read(use);
            EXPECT_THAT(hazards(), ElementsAre(HasSubstr("no barrier(" + to_string(use) + ") between")));
        }
    }
}

TEST_F(HazardTrackerTest, ABarrierBeforeTheStoreDoesNotHelp) {
    barrier(Barrier::storage);
    store();
    read(Barrier::storage);
    EXPECT_THAT(hazards(), SizeIs(1));
}

TEST_F(HazardTrackerTest, BitsOfSeveralBarriersAddUp) {
    store();
    barrier(Barrier::storage);
    barrier(Barrier::texture_fetch);
    read(Barrier::texture_fetch);
    read(Barrier::storage);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, OneBarrierServesManyReads) {
    store();
    barrier(Barrier::texture_fetch);
    read(Barrier::texture_fetch);
    store(kBuffer + 1);
    read(Barrier::texture_fetch);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, AStoreNeedsABarrierAfterAStore) {
    store();
    store();
    EXPECT_THAT(hazards(), ElementsAre(AllOf(HasSubstr("overwrites"), HasSubstr("wrote"))));
    barrier(Barrier::storage);
    store();
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, AStoreNeedsAStorageBarrierAfterAnyRead) {
    for (const Barrier use :
         {Barrier::storage, Barrier::texture_fetch, Barrier::vertex_pull, Barrier::command}) {
        for (const Barrier between : {Barrier::none, Barrier::texture_fetch | Barrier::buffer_update}) {
            tracker_.apply(BufferReset{kBuffer});
            read(use);
            barrier(between);
            store();
            EXPECT_THAT(hazards(), ElementsAre(AllOf(HasSubstr("overwrites"), HasSubstr("reads"),
                                                     HasSubstr("no barrier(storage) between"))));
        }
        tracker_.apply(BufferReset{kBuffer});
        read(use);
        barrier(Barrier::storage);
        store();
        EXPECT_THAT(hazards(), IsEmpty());
    }
}

TEST_F(HazardTrackerTest, AStoreNeedsAStorageBarrierAfterACopyReadIt) {
    transfer({kBuffer, Barrier::buffer_update, true, false, "source"});
    store();
    EXPECT_THAT(hazards(), SizeIs(1));
}

TEST_F(HazardTrackerTest, AStoreNeedsNoBarrierAfterADownload) {
    tracker_.apply(GpuCommand{GpuCommand::Kind::download,
                              "download",
                              "",
                              false,
                              {{kBuffer, Barrier::buffer_update, true, false, "source"}}});
    store();
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ATransferIsOrderedBeforeWhatFollows) {
    const BufferAccess upload{kBuffer, Barrier::buffer_update, false, true, "target"};
    transfer(upload);
    for (const Barrier use : kAllUses) read(use);
    transfer(upload);
    barrier(Barrier::storage);
    store();
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ATransferNeedsABarrierAfterAStore) {
    store();
    transfer({kBuffer, Barrier::buffer_update, false, true, "target"});
    EXPECT_THAT(hazards(), ElementsAre(HasSubstr("no barrier(buffer_update) between")));
}

TEST_F(HazardTrackerTest, OnlyATransferOfAllEndsWhatAStoreAsksFor) {
    const BufferAccess upload{kBuffer, Barrier::buffer_update, false, true, "target"};
    store();
    barrier(Barrier::buffer_update);
    transfer(upload);
    read(Barrier::texture_fetch);
    EXPECT_THAT(hazards(), SizeIs(1));
    tracker_.apply(BufferReset{kBuffer});
    store();
    barrier(Barrier::buffer_update);
    transfer(upload, true);
    read(Barrier::texture_fetch);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ACommandMayReadAndWriteABuffer) {
    const BufferAccess texels{kBuffer, Barrier::texture_fetch, true, false, "samplerBuffer positions"};
    const BufferAccess block{kBuffer, Barrier::storage, true, true, "block Positions"};
    tracker_.apply(GpuCommand{GpuCommand::Kind::shader, "both.comp", "", false, {texels, block}});
    EXPECT_THAT(hazards(), IsEmpty());
    barrier(Barrier::storage);
    tracker_.apply(GpuCommand{GpuCommand::Kind::shader, "both.comp", "", false, {texels, block}});
    EXPECT_THAT(hazards(),
                ElementsAre(AllOf(HasSubstr("samplerBuffer positions"), HasSubstr("texture_fetch"))));
}

TEST_F(HazardTrackerTest, BuffersAreApart) {
    store(1);
    read(Barrier::storage, 2);
    store(3);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ABufferMadeAnewHasNoPast) {
    store();
    tracker_.apply(BufferReset{kBuffer});
    read(Barrier::storage);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ReportsNameBothCommandsOnce) {
    for (int i = 0; i < 3; ++i) {
        store();
        read(Barrier::texture_fetch);
        barrier(Barrier::storage);
    }
    EXPECT_THAT(hazards(),
                ElementsAre("reader.comp (some_stage) reads block In (buffer 7), which writer.comp "
                            "(some_stage) wrote as block Out: no barrier(texture_fetch) between"));
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ASuppressedBarrierIsNotCounted) {
    tracker_.suppress_barrier({"src/a.cpp", 2});
    store();
    barrier(Barrier::storage, 2);
    read(Barrier::storage);
    EXPECT_THAT(hazards(), SizeIs(1));
    store(8);
    barrier(Barrier::storage, 3);
    read(Barrier::storage, 8);
    EXPECT_THAT(hazards(), IsEmpty());
}

// Line 1 is needed for its storage bit; the bit of line 2 is made up for by line 3, and the other way round.
TEST_F(HazardTrackerTest, KnowsWhichBarriersAreNeeded) {
    store();
    barrier(Barrier::storage | Barrier::command, 1);
    read(Barrier::storage);
    barrier(Barrier::texture_fetch, 2);
    barrier(Barrier::texture_fetch, 3);
    read(Barrier::texture_fetch);
    const auto sites = tracker_.barrier_sites();
    ASSERT_EQ(sites.size(), 3u);
    EXPECT_EQ(sites[0].bits, Barrier::storage | Barrier::command);
    EXPECT_EQ(sites[0].needed, Barrier::storage);
    EXPECT_EQ(sites[1].needed, Barrier::none);
    EXPECT_EQ(sites[2].needed, Barrier::none);
    EXPECT_THAT(hazards(), IsEmpty());
}

TEST_F(HazardTrackerTest, ABarrierThatOnlyRepeatsItselfIsNeeded) {
    store();
    barrier(Barrier::storage, 1);
    barrier(Barrier::storage, 1);
    read(Barrier::storage);
    EXPECT_EQ(tracker_.barrier_sites().at(0).needed, Barrier::storage);
}

TEST(CallSiteText, StartsAtTheSources) {
    EXPECT_EQ(to_string(CallSite{"/somewhere/src/gelatin/src/gl/a.cpp", 3}), "src/gl/a.cpp:3");
    EXPECT_EQ(to_string(CallSite{"../../tests/gl/a.cpp", 4}), "tests/gl/a.cpp:4");
    EXPECT_EQ(to_string(CallSite{"a.cpp", 5}), "a.cpp:5");
}

TEST(CallSite, IsWhereTheFunctionThatHasItAsDefaultIsCalled) {
    const auto site_of_caller = [](CallSite where = CallSite::here()) { return where; };
    EXPECT_EQ(site_of_caller().line, __LINE__);
    EXPECT_THAT(std::string(site_of_caller().file), HasSubstr("hazard_tracker_test.cpp"));
}

}  // namespace
}  // namespace gelatin::gl
