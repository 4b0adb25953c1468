#include "apps/gsv/process/problem_report.h"

#include <gmock/gmock.h>

namespace gsv::app {
namespace {

using base::Problem;
using testing::ElementsAre;

constexpr auto kWarning = Problem::Severity::kWarning;

TEST(ProblemReport, ReportsAProblemInManyPlacesOnce) {
  const base::Problems problems = {{kWarning, "no wind", "w.sdf:3"},
                                   {kWarning, "no fog", "w.sdf:4"},
                                   {kWarning, "no wind", "w.sdf:9"},
                                   {kWarning, "no wind", "w.sdf:9"},
                                   {Problem::Severity::kError, "no mass", "w.sdf:5"},
                                   {kWarning, "no wind", "m.sdf:1"}};
  EXPECT_THAT(GroupedSentences(problems, kWarning),
              ElementsAre("w.sdf:3: no wind (and in 2 more places)", "w.sdf:4: no fog"));
  EXPECT_THAT(GroupedSentences(problems, Problem::Severity::kError),
              ElementsAre("w.sdf:5: no mass"));
}

TEST(ProblemReport, CountsOmittedPlaces) {
  EXPECT_THAT(Shortened({"a", "b", "c"}, 2, "see"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Shortened({"a", "b", "c", "d"}, 2, "see"),
              ElementsAre("a", "b", "2 more warnings; see"));
}

}  // namespace
}  // namespace gsv::app
