#include "gsv/formats/world_writer.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using model::PlacedModel;
using testing::HasSubstr;
using testing::Not;

constexpr char kLink[] =
    "<link name='l'><collision name='c'><geometry><box><size>1 1 1</size></box></geometry>"
    "</collision></link>";

std::string Document(const std::string& content) {
  return "<?xml version='1.0'?>\n<sdf version='1.7'>\n" + content + "\n</sdf>\n";
}

const PlacedModel* Find(const model::WorldDescription& world, const std::string& name) {
  for (const PlacedModel& placed : world.models) {
    if (placed.name == name) return &placed;
  }
  return nullptr;
}

class WorldWriterTest : public testing::Test {
 protected:
  model::WorldDescription World(const std::string& content) {
    return Read(folder_.Write("w.sdf", Document(content)));
  }
  model::WorldDescription Read(const std::filesystem::path& file) {
    auto world = library_.ReadWorld(file, problems_);
    EXPECT_TRUE(world) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }
  // Writes the models to a file in another folder, and reads this file again.
  model::WorldDescription Again(const model::WorldDescription& world,
                                const std::vector<PlacedModel>& models) {
    const auto text = WriteWorld(world, models, world.gravity, {}, problems_);
    EXPECT_TRUE(text) << (text ? "" : text.error().Sentence());
    text_ = text.value_or("");
    return Read(elsewhere_.Write("again.sdf", text_));
  }
  void ExpectSame(const model::WorldDescription& again, const std::vector<PlacedModel>& models) {
    EXPECT_EQ(again.models.size(), models.size());
    for (const PlacedModel& placed : models) {
      const PlacedModel* const read = Find(again, placed.name);
      ASSERT_NE(read, nullptr) << placed.name;
      EXPECT_EQ(read->world_from_model, placed.world_from_model) << placed.name;
      EXPECT_EQ(read->is_static, placed.is_static) << placed.name;
      EXPECT_EQ(read->model->links.size(), placed.model->links.size()) << placed.name;
    }
  }

  base::testing::TestFolder folder_, elsewhere_;
  ModelLibrary library_;
  base::Problems problems_;
  std::string text_;
};

geometry::Pose Tilted() {
  return {{0.1, -2.0 / 3, 1e-7}, geometry::FromRollPitchYaw({0.3, -0.7, 2.9})};
}

TEST_F(WorldWriterTest, MovedRemovedAndAddedModelsAreReadBackWithEqualBits) {
  const auto world = World("<world name='w'><model name='a'><pose>1 2 3 0 0 0.1</pose>" +
                           std::string(kLink) + "</model><model name='b'>" + kLink +
                           "</model><model name='c'>" + kLink + "</model></world>");
  const auto shape = library_.ReadModel("shape:box?size=0.4,0.4,0.4&mass=8", problems_);
  ASSERT_TRUE(shape);
  std::vector<PlacedModel> models{world.models[0], world.models[1]};
  models[1].world_from_model = Tilted();
  models.push_back({"crate", *shape, Tilted(), false});
  models.push_back({"copy", world.models[2].model, {{7, 8, 9}, {}}, false});
  ExpectSame(Again(world, models), models);
  EXPECT_THAT(text_, HasSubstr("<pose>1 2 3 0 0 0.1</pose>"));  // unchanged
  EXPECT_THAT(text_, Not(HasSubstr("<model name=\"c\">")));
}

TEST_F(WorldWriterTest, IncludesAreKeptAndFoundFromAnotherFolder) {
  folder_.Write("models/chair/model.config",
                "<model><name>chair</name><sdf version='1.7'>model.sdf</sdf></model>");
  folder_.Write("models/chair/model.sdf",
                Document("<model name='chair'>" + std::string(kLink) + "</model>"));
  const auto world = World(
      "<world name='w'><include><uri>model://chair</uri></include>"
      "<include><uri>model://chair</uri><name>other</name><pose>1 0 0 0 0 0</pose></include>"
      "<include><uri>model://chair</uri><pose>2 0 0 0 0 0</pose></include></world>");
  ASSERT_EQ(world.models.size(), 3u);
  std::vector<PlacedModel> models = world.models;
  models[1].world_from_model.position.x = -4;
  models.push_back({"added", world.models[0].model, Tilted(), true});
  ExpectSame(Again(world, models), models);
  models.erase(models.begin());
  ExpectSame(Again(world, models), models);
}

TEST_F(WorldWriterTest, AWorldWithASavedStateStaysWhereItIs) {
  const auto model = [](const std::string& name) {
    return "<model name='" + name + "'>" + kLink + "</model>";
  };
  const auto world = World(
      "<world name='w'><light name='sun' type='point'/><light name='off' type='point'/>" +
      model("shelf") + model("gone") +
      "<state world_name='w'><deletions><name>gone</name><name>off</name></deletions><insertions>" +
      model("new") +
      "</insertions><model name='shelf'><pose>5 0 0 0 0 0</pose></model>"
      "<light name='sun'><pose>1 2 3 0 0 0</pose></light></state></world>");
  ASSERT_EQ(world.models.size(), 2u);
  const auto again = Again(world, world.models);
  ExpectSame(again, world.models);
  EXPECT_EQ(Find(again, "shelf")->world_from_model.position.x, 5);
  ASSERT_EQ(again.lights.size(), 1u);
  EXPECT_EQ(again.lights[0].world_from_light.position, (geometry::Vector3{1, 2, 3}));
}

TEST_F(WorldWriterTest, MovesAnIncludeWhoseFileNamesAFrameForItsPose) {
  folder_.Write("models/chair/model.sdf",
                Document("<model name='chair' placement_frame='foot'>" + std::string(kLink) +
                         "<frame name='foot'><pose>0 0 -0.5 0 0 0</pose></frame></model>"));
  const auto world = World(
      "<world name='w'><include><uri>models/chair/model.sdf</uri><pose>1 0 0 0 0 0</pose></include>"
      "</world>");
  ASSERT_EQ(world.models.size(), 1u);
  EXPECT_EQ(world.models[0].world_from_model.position.z, 0.5);
  std::vector<PlacedModel> models = world.models;
  ExpectSame(Again(world, models), models);
  models[0].world_from_model.position.x = 4;
  ExpectSame(Again(world, models), models);
}

TEST_F(WorldWriterTest, NamesFilesOfTheModelPathWithoutTheirAbsolutePaths) {
  const auto arm = folder_.Write("models/parts/sdf/arm.sdf",
                                 Document("<model name='arm'>" + std::string(kLink) + "</model>"));
  const auto world = Read(
      folder_.Write("models/parts/w.sdf", Document("<world name='w'><include><uri>sdf/arm.sdf</uri>"
                                                   "</include></world>")));
  ASSERT_EQ(world.models.size(), 1u);
  std::vector<PlacedModel> models = world.models;
  models.push_back({"second", *library_.ReadModel(arm, problems_), Tilted(), false});
  problems_.clear();
  const ReadOptions options{.model_path = {arm.parent_path().parent_path().parent_path()}};
  const auto text = WriteWorld(world, models, world.gravity, options, problems_);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("<uri>model://parts/sdf/arm.sdf</uri>"));
  EXPECT_THAT(*text, Not(HasSubstr("file://")));
  EXPECT_TRUE(problems_.empty());
  ModelLibrary with_path(options);
  const auto again = with_path.ReadWorld(elsewhere_.Write("again.sdf", *text), problems_);
  ASSERT_TRUE(again);
  ExpectSame(*again, models);
  // Without the model path, the names are absolute, and a warning reports them.
  ExpectSame(Again(world, models), models);
  EXPECT_THAT(text_, HasSubstr("<uri>file://" + arm.string() + "</uri>"));
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].message,
              HasSubstr("names 1 file by the path on this computer, such as " + arm.string()));
}

TEST_F(WorldWriterTest, ModelsPlacedRelativeToAMovedModelStay) {
  const auto world =
      World("<world name='w'><model name='a'><pose>1 0 0 0 0 0</pose>" + std::string(kLink) +
            "</model><model name='b'><pose relative_to='a'>0 1 0 0 0 0</pose>" + kLink +
            "</model></world>");
  std::vector<PlacedModel> models = world.models;
  models[0].world_from_model.position.x = 5;
  ExpectSame(Again(world, models), models);
}

TEST_F(WorldWriterTest, ASingleModelBecomesAWorldThatIncludesIt) {
  const auto file = folder_.Write(
      "crate.sdf", Document("<model name='crate'>" + std::string(kLink) + "</model>"));
  const auto world = Read(file);
  ASSERT_EQ(world.models.size(), 2u);
  std::vector<PlacedModel> models = world.models;
  models[1].world_from_model = Tilted();
  ExpectSame(Again(world, models), models);
}

TEST_F(WorldWriterTest, KeepsElementsThatAreNotSimulatedAndWritesTheGravity) {
  const auto world = World(
      "<world name='w'><plugin name='p' filename='libunknown.so'><rate>3</rate></plugin>"
      "<light name='lamp' type='point'><pose>0 0 3 0 0 0</pose></light></world>");
  const auto text = WriteWorld(world, {}, {0, 0, -1.62}, {}, problems_);
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("libunknown.so"));
  EXPECT_THAT(*text, HasSubstr("<gravity>0 0 -1.62</gravity>"));
  EXPECT_THAT(*text, HasSubstr("lamp"));
}

TEST_F(WorldWriterTest, LibsdformatAcceptsTheText) {
  folder_.Write("models/chair/model.config",
                "<model><name>chair</name><sdf version='1.7'>model.sdf</sdf></model>");
  folder_.Write("models/chair/model.sdf",
                Document("<model name='chair'>" + std::string(kLink) + "</model>"));
  const auto world = World("<world name='w'><include><uri>model://chair</uri></include></world>");
  const auto shape = library_.ReadModel("shape:wall?size=4,0.1,2", problems_);
  ASSERT_TRUE(shape);
  std::vector<PlacedModel> models = world.models;
  models.push_back({"wall", *shape, Tilted(), true});
  models.push_back({"second", world.models[0].model, Tilted(), false});
  (void)Again(world, models);
  sdf::Root root;
  const sdf::Errors errors = root.LoadSdfString(text_);
  for (const sdf::Error& error : errors) ADD_FAILURE() << error.Message();
  ASSERT_NE(root.WorldByIndex(0), nullptr);
  EXPECT_EQ(root.WorldByIndex(0)->ModelCount(), 3u);
  ASSERT_NE(root.WorldByIndex(0)->ModelByName("second"), nullptr);
  EXPECT_NEAR(root.WorldByIndex(0)->ModelByName("second")->RawPose().Rot().Yaw(), 2.9, 1e-9);
}

TEST_F(WorldWriterTest, ReportsModelsThatCannotBeSaved) {
  const auto world = World("<world name='w'/>");
  auto made = std::make_shared<model::Model>();
  made->links.resize(1);
  const auto text = WriteWorld(world, {{"made", made, {}, false}}, world.gravity, {}, problems_);
  ASSERT_TRUE(text);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("has no file"));
  model::WorldDescription gone = world;
  gone.source = (elsewhere_.path() / "gone.sdf").string();
  EXPECT_FALSE(WriteWorld(gone, {}, world.gravity, {}, problems_));
}

}  // namespace
}  // namespace gsv::formats
