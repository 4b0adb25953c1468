#include "gsv/presentation/edit_message.h"

#include <gtest/gtest.h>

namespace gsv::presentation {
namespace {

using simulation::Edit;

Edit AddedRobot() {
  Edit edit;
  edit.step = 120;
  edit.time = std::chrono::milliseconds(1200);
  edit.kind = Edit::Kind::kAddRobot;
  edit.moment = Edit::Moment::kAfterTurns;
  edit.halt = 7;
  edit.body = "rover_2";
  edit.model = "/models/rover4/model.sdf";
  edit.behaviour = "wander";
  edit.movement = model::Movement::kRigid;
  edit.world_from_body = {{1, -2, 0.1}, {0.5, 0.5, -0.5, 0.5}};
  edit.on_ground = false;
  return edit;
}

TEST(EditMessage, ContainsAllPartsOfAnEdit) {
  const Edit edit = AddedRobot();
  const auto back = EditFrom(EditMessage(edit));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->step, 120);
  EXPECT_EQ(back->time, edit.time);
  EXPECT_EQ(back->kind, Edit::Kind::kAddRobot);
  EXPECT_EQ(back->moment, Edit::Moment::kAfterTurns);
  EXPECT_EQ(back->halt, 7u);
  EXPECT_EQ(back->body, "rover_2");
  EXPECT_EQ(back->model, "/models/rover4/model.sdf");
  EXPECT_EQ(back->copy_of, "");
  EXPECT_EQ(back->behaviour, "wander");
  EXPECT_EQ(back->movement, model::Movement::kRigid);
  EXPECT_EQ(back->world_from_body.position, edit.world_from_body.position);
  EXPECT_EQ(back->world_from_body.orientation, edit.world_from_body.orientation);
  EXPECT_FALSE(back->on_ground);
}

TEST(EditMessage, KeepsAChosenDriveWithAndWithoutAMovement) {
  Edit edit = AddedRobot();
  edit.drive = "diff,left=a b,radius=0.1";
  EXPECT_EQ(EditMessage(edit).movement, "rigid drive diff,left=a b,radius=0.1");
  for (const bool has_movement : {true, false}) {
    if (!has_movement) edit.movement.reset();
    const auto back = EditFrom(EditMessage(edit));
    ASSERT_TRUE(back) << back.error().Sentence();
    EXPECT_EQ(back->drive, edit.drive);
    EXPECT_EQ(back->movement, edit.movement);
  }
}

TEST(EditMessage, KeepsACommandAndItsArguments) {
  Edit edit;
  edit.kind = Edit::Kind::kCommand;
  edit.command = "set_gravity";
  edit.arguments = {{"of", "a=b"}, {"z", "-1.62"}};
  const auto back = EditFrom(EditMessage(edit));
  ASSERT_TRUE(back) << back.error().Sentence();
  EXPECT_EQ(back->kind, Edit::Kind::kCommand);
  EXPECT_EQ(back->command, "set_gravity");
  EXPECT_EQ(back->arguments, edit.arguments);
  EXPECT_EQ(back->body, "");
  EXPECT_EQ(back->model, "");
  edit.arguments.clear();
  EXPECT_TRUE(EditFrom(EditMessage(edit))->arguments.empty());
}

TEST(EditMessage, ImpossibleEditIsRejected) {
  const auto is_refused = [](auto change) {
    messages::gsv_msgs::Edit message = EditMessage(AddedRobot());
    change(message);
    return !EditFrom(message);
  };
  EXPECT_FALSE(is_refused([](auto&) {}));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.kind = "explode"; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.moment = ""; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.movement = "by magic"; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.body = ""; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.step = ~std::uint64_t{0}; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.pose.position.x = 1 / 0.0; }));
  EXPECT_TRUE(is_refused([](auto& edit) { edit.pose.orientation.w = 7; }));
}

}  // namespace
}  // namespace gsv::presentation
