#include "gsv/recording/attachments/source_attachments.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_recording.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {
namespace {

using testing::ElementsAre;
using testing::Pair;

class SourceAttachmentsTest : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_->path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }

  // Records one step of a world, and returns the recording's attachments by name. `world` and
  // `robots` are the paths of the source files.
  std::map<std::string, std::string> Record(const std::string& world,
                                            const std::vector<std::string>& robots) const {
    simulation::Specification specification = simulation::Lockstep(10ms);
    auto description = *specification.world;
    description.source = world;
    specification.world = std::make_shared<const model::WorldDescription>(std::move(description));
    const auto simulation = simulation::Make(std::move(specification));
    for (std::size_t i = 0; i < robots.size(); ++i) {
      simulation::RobotSpecification robot =
          Robot("robot_" + std::to_string(i), static_cast<double>(i), nullptr);
      auto model = *robot.model;
      model.source = robots[i];
      robot.model = std::make_shared<const model::Model>(std::move(model));
      EXPECT_TRUE(simulation->AddRobot(robot));
    }
    const std::string path = folder_->path() / "run.mcap";
    RecorderOptions options;
    options.replace = true;
    options.write_glb = [](const model::Model&) {
      return base::Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(4));
    };
    const auto recorder = SimulationRecorder::Start(simulation, path, std::move(options));
    EXPECT_TRUE(recorder);
    RunToEnd(*simulation);
    EXPECT_TRUE((*recorder)->Stop());
    return XmlIn(path);
  }

  static std::map<std::string, std::string> XmlIn(const std::string& path) {
    const auto reader = McapReader::Open(path);
    std::map<std::string, std::string> found;
    for (const AttachmentIndexRecord& index : (*reader)->summary().attachments) {
      if (index.media_type != "application/xml") continue;
      const Attachment attachment = (*reader)->Read(index).value();
      found[index.name] = std::string(reinterpret_cast<const char*>(attachment.data.data()),
                                      attachment.data.size());
    }
    return found;
  }

  const base::Result<base::TemporaryFolder> folder_ = base::TemporaryFolder::Make("gsv-test");
};

TEST_F(SourceAttachmentsTest, ContainEachFileOfWorldAndRobotsOnce) {
  const std::string world = Write("hall.sdf", "<sdf>hall</sdf>");
  const std::string pebble = Write("pebble/model.sdf", "<sdf>pebble</sdf>");
  const std::string rover = Write("rover/model.sdf", "<sdf>rover</sdf>");
  EXPECT_THAT(Record(world, {pebble, rover, pebble}),
              ElementsAre(Pair("robots/pebble/model.sdf", "<sdf>pebble</sdf>"),
                          Pair("robots/rover/model.sdf", "<sdf>rover</sdf>"),
                          Pair("world/hall.sdf", "<sdf>hall</sdf>")));
}

TEST_F(SourceAttachmentsTest, FilesWithEqualNamesGetANumber) {
  const std::string mine = Write("mine/pebble/model.sdf", "mine");
  const std::string yours = Write("yours/pebble/model.sdf", "yours");
  EXPECT_THAT(Record("", {mine, yours}), ElementsAre(Pair("robots/2/pebble/model.sdf", "yours"),
                                                     Pair("robots/pebble/model.sdf", "mine")));
}

TEST_F(SourceAttachmentsTest, OmitMissingAndTooLargeFiles) {
  const std::string large = Write("large/model.sdf", std::string(kMaxSourceBytes + 1, ' '));
  const std::string full = Write("full/model.sdf", std::string(kMaxSourceBytes, ' '));
  const auto found = Record(folder_->path() / "gone.sdf", {large, full, folder_->path()});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found.begin()->first, "robots/full/model.sdf");
  EXPECT_EQ(found.begin()->second.size(), kMaxSourceBytes);
}

}  // namespace
}  // namespace gsv::recording
