#include "gsv/presentation/notes.h"

#include <gtest/gtest.h>

namespace gsv::presentation {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

simulation::Event Note(std::string detail) {
  return {300, seconds(3), std::string(kNoteEvent), "pebble", std::move(detail), nullptr};
}

TEST(Notes, MessageIsStampedWithTheInstantOfTheNote) {
  const auto message = NoteMessage(Note(NoteDetail(milliseconds(1250), "turns: at 2 s: late")));
  EXPECT_EQ(message.stamp.sec, 1);
  EXPECT_EQ(message.stamp.nanosec, 250'000'000u);
  EXPECT_EQ(message.detail, "turns: at 2 s: late");
  EXPECT_EQ(message.event, "note");
  EXPECT_EQ(message.robot, "pebble");
}

TEST(Notes, WithoutAnInstantTheNoteHasTheTimeOfTheEvent) {
  for (const char* detail :
       {"plain", "at noon", "at x s: y", "at -1 s: y", "at 1e300 s: y", "at 1"}) {
    EXPECT_EQ(TimeOfNote(Note(detail)), seconds(3)) << detail;
    EXPECT_EQ(NoteMessage(Note(detail)).detail, detail);
  }
}

}  // namespace
}  // namespace gsv::presentation
