// Tests how media and properties of bodies are read: bitmasks, wind, fluids, velocity decay,
// kinematic links, automatic inertia, and mimic joints.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SdfMedium : public ::testing::Test {
 protected:
  model::WorldDescription World(const std::string& content, const std::string& version = "1.9") {
    const std::string text =
        "<sdf version='" + version + "'><world name='w'>" + content + "</world></sdf>";
    auto world = ModelLibrary().ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_TRUE(world.has_value()) << (world ? "" : world.error().Sentence());
    return world.value_or(model::WorldDescription{});
  }

  model::Model ModelOf(const std::string& content, const std::string& version = "1.9") {
    const auto world = World("<model name='m'>" + content + "</model>", version);
    EXPECT_EQ(world.models.size(), 1u);
    return world.models.empty() ? model::Model{} : *world.models[0].model;
  }

  model::CollisionFilter FilterOf(const std::string& contact) {
    const auto model = ModelOf(
        "<link name='l'><collision "
        "name='c'><geometry><sphere><radius>1</radius></sphere></geometry>"
        "<surface><contact>" +
        contact + "</contact></surface></collision></link>");
    return model.links.at(0).collisions.at(0).surface.filter;
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

constexpr char kSolidBox[] =
    "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>";

TEST_F(SdfMedium, ABitmaskIsAlsoTheCategoryUnlessACategoryIsGiven) {
  EXPECT_EQ(FilterOf(""), (model::CollisionFilter{0xFFFF, 0xFFFF}));
  EXPECT_EQ(FilterOf("<collide_bitmask>5</collide_bitmask>"), (model::CollisionFilter{5, 5}));
  EXPECT_EQ(FilterOf("<collide_bitmask>0</collide_bitmask>"), model::kMeetsNothing);
  EXPECT_EQ(FilterOf("<category_bitmask>2</category_bitmask><collide_bitmask>5</collide_bitmask>"),
            (model::CollisionFilter{2, 5}));
  EXPECT_EQ(FilterOf("<collide_bitmask>4294967295</collide_bitmask>"), model::CollisionFilter{});
  for (const base::Problem& problem : problems_) ADD_FAILURE() << problem.Sentence();
}

TEST_F(SdfMedium, ACollisionWithoutContactCollidesWithNothingUnlessABitmaskAllowsIt) {
  EXPECT_EQ(FilterOf("<collide_without_contact>true</collide_without_contact>"),
            model::kMeetsNothing);
  EXPECT_EQ(FilterOf("<collide_without_contact>true</collide_without_contact>"
                     "<collide_bitmask>1</collide_bitmask>"),
            (model::CollisionFilter{1, 1}));
}

TEST_F(SdfMedium, LinksAreReadWithWindKinematicAndDecay) {
  const auto model = ModelOf(
      "<enable_wind>true</enable_wind><link name='a'><kinematic>true</kinematic></link>"
      "<link name='b'><enable_wind>false</enable_wind><velocity_decay><linear>0.1</linear>"
      "<angular>0.2</angular></velocity_decay></link>");
  ASSERT_EQ(model.links.size(), 2u);
  EXPECT_TRUE(model.links[0].is_kinematic);
  EXPECT_TRUE(model.links[0].has_wind);
  EXPECT_FALSE(model.links[1].is_kinematic);
  EXPECT_FALSE(model.links[1].has_wind);
  EXPECT_EQ(model.links[1].linear_decay, 0.1);
  EXPECT_EQ(model.links[1].angular_decay, 0.2);
  EXPECT_TRUE(problems_.empty());
}

TEST_F(SdfMedium, DecayOutsideOfZeroToOneIsIgnored) {
  const auto model =
      ModelOf("<link name='a'><velocity_decay><linear>1.5</linear></velocity_decay></link>");
  EXPECT_EQ(model.links.at(0).linear_decay, 0);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("must lie between 0 and 1, not"));
}

TEST_F(SdfMedium, WindIsReadWithTheFactorOfItsPlugin) {
  const auto world = World(R"(<wind><linear_velocity>1 -2 0.5</linear_velocity></wind>
      <plugin filename='gz-sim-wind-effects-system' name='gz::sim::systems::WindEffects'>
      <force_approximation_scaling_factor>0.25</force_approximation_scaling_factor></plugin>)");
  ASSERT_TRUE(world.wind);
  EXPECT_EQ(world.wind->velocity, (geometry::Vector3{1, -2, 0.5}));
  EXPECT_EQ(world.wind->drag, 0.25);
  EXPECT_TRUE(problems_.empty());
  EXPECT_FALSE(World("<wind><linear_velocity>0 0 0</linear_velocity></wind>").wind);
}

TEST_F(SdfMedium, WindThatVariesIsReported) {
  World(R"(<wind><linear_velocity>1 0 0</linear_velocity></wind>
      <plugin filename='libWindPlugin.so' name='wind'>
      <horizontal><magnitude><time_for_rise>10</time_for_rise></magnitude></horizontal></plugin>)");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("the wind is constant"));
}

TEST_F(SdfMedium, AFluidIsReadWithItsLayers) {
  const auto uniform = World(
      "<plugin filename='gz-sim-buoyancy-system' name='gz::sim::systems::Buoyancy'>"
      "<uniform_fluid_density>900</uniform_fluid_density><enable>boat</enable></plugin>");
  ASSERT_TRUE(uniform.fluid);
  EXPECT_EQ(uniform.fluid->density, 900);
  EXPECT_THAT(uniform.fluid->lifted, ElementsAre("boat"));
  const auto graded = World(
      "<plugin filename='libignition-gazebo-buoyancy-system.so' "
      "name='ignition::gazebo::systems::Buoyancy'><graded_buoyancy>"
      "<default_density>1025</default_density>"
      "<density_change><above_depth>5</above_depth><density>0.5</density></density_change>"
      "<density_change><above_depth>0</above_depth><density>1</density></density_change>"
      "</graded_buoyancy></plugin>");
  ASSERT_TRUE(graded.fluid);
  EXPECT_EQ(graded.fluid->density, 1025);
  ASSERT_EQ(graded.fluid->layers.size(), 2u);
  EXPECT_EQ(graded.fluid->layers[0].above, 0);
  EXPECT_EQ(graded.fluid->layers[1].density, 0.5);
  EXPECT_TRUE(problems_.empty());
}

// A box of 6 m³ with 500 kg/m³ has the moments m (b² + c²)/12.
TEST_F(SdfMedium, InertiaIsComputedFromShapes) {
  const auto model = ModelOf(
      "<link name='l'><inertial auto='true'><density>500</density>"
      "</inertial>" +
          std::string(kSolidBox) + "</link>",
      "1.11");
  EXPECT_THAT(problems_, IsEmpty());
  const model::Inertial& inertial = model.links.at(0).inertial;
  EXPECT_DOUBLE_EQ(inertial.mass, 3000);
  EXPECT_DOUBLE_EQ(inertial.ixx, 3000 * 13.0 / 12);
  EXPECT_DOUBLE_EQ(inertial.iyy, 3000 * 10.0 / 12);
  EXPECT_DOUBLE_EQ(inertial.izz, 3000 * 5.0 / 12);
}

// Two cubes of 1 m³ at x = ±2. One of them is three times as dense. Their common centre is at x =
// 1, and their distances d from it, 1 and 3, add m d² to the inertia.
TEST_F(SdfMedium, InertiaAddsUpShapesOfDifferentDensity) {
  const auto cube = [](const std::string& name, const std::string& x, const std::string& density) {
    return "<collision name='" + name + "'><pose>" + x + " 0 0 0 0 0.7853981633974483</pose>" +
           "<density>" + density +
           "</density><geometry><box><size>1 1 1</size></box></geometry>"
           "</collision>";
  };
  const auto model = ModelOf("<link name='l'><inertial auto='true'/>" + cube("a", "2", "3000") +
                                 cube("b", "-2", "1000") + "</link>",
                             "1.11");
  EXPECT_THAT(problems_, IsEmpty());
  const model::Inertial& inertial = model.links.at(0).inertial;
  EXPECT_NEAR(inertial.mass, 4000, 1e-6);
  EXPECT_NEAR(inertial.link_from_com.position.x, 1, 1e-12);
  EXPECT_NEAR(inertial.ixx, 4000.0 / 6, 1e-6);
  EXPECT_NEAR(inertial.izz, 4000.0 / 6 + 3000 * 1 + 1000 * 9, 1e-6);
  EXPECT_NEAR(inertial.ixy, 0, 1e-6);
}

TEST_F(SdfMedium, AMassBesideAutomaticInertiaScalesIt) {
  const auto model = ModelOf("<link name='l'><inertial auto='true'><mass>12</mass></inertial>" +
                                 std::string(kSolidBox) + "</link>",
                             "1.11");
  EXPECT_DOUBLE_EQ(model.links.at(0).inertial.mass, 12);
  EXPECT_DOUBLE_EQ(model.links.at(0).inertial.ixx, 13);
}

TEST_F(SdfMedium, AutomaticInertiaNeedsAVolume) {
  ModelOf("<link name='l'><inertial auto='true'/></link>", "1.11");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("needs collision shapes that have a volume"));
}

constexpr char kTwoJoints[] =
    "<link name='a'/><link name='b'/><link name='c'/>"
    "<joint name='leader' type='revolute'><parent>a</parent><child>b</child>"
    "<axis><xyz>0 0 1</xyz></axis></joint>"
    "<joint name='follower' type='revolute'><parent>a</parent><child>c</child>"
    "<axis><xyz>0 0 1</xyz>";

TEST_F(SdfMedium, AMimicJointIsReadFromSdformat) {
  const auto model = ModelOf(std::string(kTwoJoints) +
                                 "<mimic joint='leader'><multiplier>-2</multiplier>"
                                 "<offset>0.5</offset><reference>0.1</reference></mimic>"
                                 "</axis></joint>",
                             "1.11");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_EQ(model.joints.size(), 2u);
  EXPECT_FALSE(model.joints[0].mimic);
  ASSERT_TRUE(model.joints[1].mimic);
  EXPECT_EQ(model.joints[1].mimic->leader, 0);
  EXPECT_EQ(model.joints[1].mimic->multiplier, -2);
  EXPECT_EQ(model.joints[1].mimic->offset, 0.5);
  EXPECT_EQ(model.joints[1].mimic->reference, 0.1);
}

TEST_F(SdfMedium, AMimicJointIsReadFromUrdf) {
  const auto link = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' "
           "ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  };
  const auto joint = [](const std::string& name, const std::string& child,
                        const std::string& more) {
    return "<joint name='" + name + "' type='continuous'><parent link='a'/><child link='" + child +
           "'/><axis xyz='0 0 1'/>" + more + "</joint>";
  };
  const auto path = folder_.Write(
      "r.urdf", "<robot name='r'>" + link("a") + link("b") + link("c") + joint("leader", "b", "") +
                    joint("follower", "c", "<mimic joint='leader' multiplier='3' offset='1'/>") +
                    "</robot>");
  const auto model = ModelLibrary().ReadModel(path, problems_);
  ASSERT_TRUE(model.has_value()) << model.error().Sentence();
  EXPECT_THAT(problems_, IsEmpty());
  const int follower = model::FindJoint((*model)->joints, "follower");
  ASSERT_GE(follower, 0);
  const auto& mimic = (*model)->joints[static_cast<std::size_t>(follower)].mimic;
  ASSERT_TRUE(mimic);
  EXPECT_EQ((*model)->joints[static_cast<std::size_t>(mimic->leader)].name, "leader");
  EXPECT_EQ(mimic->multiplier, 3);
  EXPECT_EQ(mimic->offset, 1);
}

TEST_F(SdfMedium, AMimicOfAMissingJointOrOfItselfIsIgnored) {
  for (const char* leader : {"absent", "follower"}) {
    problems_.clear();
    const auto model =
        ModelOf(std::string(kTwoJoints) + "<mimic joint='" + leader + "'/></axis></joint>", "1.11");
    EXPECT_FALSE(model.joints.at(1).mimic);
    ASSERT_EQ(problems_.size(), 1u) << leader;
    EXPECT_THAT(problems_[0].Sentence(),
                HasSubstr("the <mimic> of the joint \"follower\" is ignored"));
  }
}

}  // namespace
}  // namespace gsv::formats
