// Tests <gsv:pedestrians> of a world.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/model/pedestrian_group.h"

namespace gsv::formats {
namespace {

class SdfPedestrians : public ::testing::Test {
 protected:
  model::WorldDescription World(const std::string& content) {
    const std::string text = "<sdf version='1.9'><world name='w'>" + content + "</world></sdf>";
    auto world = ModelLibrary().ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(SdfPedestrians, AreReadWithTheirRoute) {
  const auto world = World(R"(<gsv:pedestrians name='guest' count='12'>
      <gsv:goal>-3 0.5 2</gsv:goal><gsv:goal> 4 1 </gsv:goal><gsv:goal>5 2</gsv:goal>
      <gsv:speed>0.9</gsv:speed><gsv:speed_deviation>0.1</gsv:speed_deviation>
      <gsv:radius>0.3</gsv:radius><gsv:height>1.6</gsv:height><gsv:z>2</gsv:z>
      </gsv:pedestrians>)");
  EXPECT_TRUE(problems_.empty());
  ASSERT_EQ(world.pedestrians.size(), 1u);
  model::PedestrianGroup expected;
  expected.name = "guest";
  expected.count = 12;
  expected.route = {{-3, 0.5, 2}, {4, 1, 0}, {5, 2, 0}};
  expected.speed = 0.9;
  expected.speed_deviation = 0.1;
  expected.radius = 0.3;
  expected.height = 1.6;
  expected.z = 2;
  EXPECT_EQ(*world.pedestrians[0], expected);
}

TEST_F(SdfPedestrians, InvalidGroupsAreSkipped) {
  const auto world = World(R"(<gsv:pedestrians/>
      <gsv:pedestrians><gsv:goal>here</gsv:goal></gsv:pedestrians>
      <gsv:pedestrians><gsv:goal>1 2 3 4</gsv:goal></gsv:pedestrians>
      <gsv:pedestrians><gsv:goal>1 2 -</gsv:goal></gsv:pedestrians>
      <gsv:pedestrians><gsv:goal>1</gsv:goal></gsv:pedestrians>
      <gsv:pedestrians count='many'><gsv:goal>1 2</gsv:goal></gsv:pedestrians>
      <gsv:pedestrians><gsv:goal>1 2</gsv:goal><gsv:speed>fast</gsv:speed></gsv:pedestrians>)");
  EXPECT_TRUE(world.pedestrians.empty());
  ASSERT_EQ(problems_.size(), 7u);
  for (const base::Problem& problem : problems_) {
    EXPECT_THAT(problem.Sentence(), ::testing::HasSubstr("the pedestrians are ignored"));
  }
}

TEST_F(SdfPedestrians, ReportsElementsThatDoNotBelongToAGroup) {
  const auto world = World(
      "<gsv:pedestrians crowd='1'><gsv:goal>1 2</gsv:goal><gsv:count>3</gsv:count>"
      "<goal>3 4</goal></gsv:pedestrians>");
  ASSERT_EQ(world.pedestrians.size(), 1u);
  std::vector<std::string> messages;
  for (const base::Problem& problem : problems_) messages.push_back(problem.message);
  EXPECT_THAT(messages, ::testing::IsSupersetOf(
                            {"<gsv:pedestrians> has no attribute \"crowd\"; it is ignored",
                             "<gsv:count> is not an element of <gsv:pedestrians>; it is ignored",
                             "<goal> is not an element of <gsv:pedestrians>; it is ignored"}));
}

}  // namespace
}  // namespace gsv::formats
