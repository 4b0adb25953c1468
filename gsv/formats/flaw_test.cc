// Tests that a single error in a file affects one part only. A warning names this part, and all
// other parts are read.
#include <filesystem>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::UnorderedElementsAre;

constexpr char kCube[] = "<geometry><box><size>1 1 1</size></box></geometry>";

class FlawTest : public testing::Test {
 protected:
  // Reads a world with one valid model and `content`, which begins on line 2.
  model::WorldDescription World(const std::string& content, const std::string& version = "1.9") {
    problems_.clear();
    const auto world = ModelLibrary().ReadWorld(
        folder_.Write("w.sdf", "<sdf version='" + version +
                                   "'><world name='w'><model name='sound'><link "
                                   "name='l'><pose>7 0 0 0 0 0</pose></link></model>\n" +
                                   content + "</world></sdf>"),
        problems_);
    EXPECT_TRUE(world.has_value()) << world.error().Sentence();
    return world.value_or(model::WorldDescription{});
  }
  std::shared_ptr<const model::Model> Model(const std::string& file, const std::string& text) {
    problems_.clear();
    const auto model = ModelLibrary().ReadModel(folder_.Write(file, text).string(), problems_);
    EXPECT_TRUE(model.has_value()) << model.error().Sentence();
    return model.value_or(std::make_shared<const model::Model>());
  }
  std::shared_ptr<const model::Model> Robot(const std::string& content) {
    return Model("r.urdf", "<robot name='r'>\n" + content + "</robot>");
  }
  // Returns all problems of the last World(), which must be warnings.
  std::vector<std::string> Messages() const {
    std::vector<std::string> said;
    for (const base::Problem& problem : problems_) {
      EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning) << problem.Sentence();
      EXPECT_LT(problem.message.size(), 400u);
      said.push_back(problem.Sentence());
    }
    return said;
  }
  static const model::Model* Find(const model::WorldDescription& world, const std::string& name) {
    for (const auto& placed : world.models) {
      if (placed.name == name) return placed.model.get();
    }
    return nullptr;
  }
  static std::vector<std::string> LinksOf(const model::Model& model) {
    std::vector<std::string> names;
    for (const auto& link : model.links) names.push_back(link.name);
    return names;
  }
  static std::vector<std::string> JointsOf(const model::Model& model) {
    std::vector<std::string> names;
    for (const auto& joint : model.joints) names.push_back(joint.name);
    return names;
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

// Each case is an invalid value, and a part of the warning about it.
TEST_F(FlawTest, AnInvalidValueIsReplaced) {
  const std::pair<const char*, const char*> links[] = {
      {"<pose>1 2 3 0 0</pose>", "6 numbers are expected; 1 2 3 0 0 0 is used"},
      {"<pose>1 2 3 0 0 north</pose>", "1 2 3 0 0 0 is used"},
      {"<gravity>9.8</gravity>", "true or false is expected; true is used"},
      {"<inertial><mass>heavy</mass></inertial>", "a number is expected; 1 is used"},
      {"<inertial><mass>2.5kg</mass></inertial>", "one number is expected; 2.5 is used"},
      {"<visual name='v'><material><diffuse>255 0 51 "
       "255</diffuse></material><geometry><box><size>1 "
       "1 1</size></box></geometry></visual>",
       "numbers between 0 and 1 are expected; 1 0 0.2 1 is used"},
      {"<visual><geometry><box><size>1 1 1</size></box></geometry></visual>",
       "has no @name; \"unnamed_visual\" is used"},
      {"<sensor name='s'/>", "<sensor> \"s\" has no type; it is ignored"}};
  for (const auto& [link, part] : links) {
    const auto world =
        World("<model name='other'><link name='l'>" + std::string(link) + "</link></model>");
    EXPECT_THAT(world.models, SizeIs(2)) << link;
    EXPECT_THAT(Messages(), Contains(AllOf(HasSubstr("w.sdf:2"), HasSubstr(part)))) << link;
  }
}

TEST_F(FlawTest, AnErrorOfTheWorldItselfDoesNotAffectItsModels) {
  for (const char* content :
       {"<physics type='ode'><max_step_size>fast</max_step_size></physics>",
        "<gravity>0 0</gravity>", "<light name='x' type='bulb'/>", "<light name='x'/>",
        "<scene><ambient>300 0 0 1</ambient></scene>",
        "<gui><camera name='c'><pose>1 2</pose></camera></gui>",
        "<state world_name='w'><model name='m'><pose>1 2</pose></model></state>"}) {
    EXPECT_THAT(World(content).models, SizeIs(1)) << content;
    EXPECT_THAT(Messages(), Not(IsEmpty())) << content;
  }
}

TEST_F(FlawTest, InvalidLightIsRepaired) {
  const auto world = World(
      "<light name='a' type='spot'><attenuation><range>-1</range></attenuation><spot><inner_angle>5"
      "</inner_angle><outer_angle>nan</outer_angle></spot></light><light name='b' "
      "type='spot'><spot>"
      "<inner_angle>0.8</inner_angle><outer_angle>0.6</outer_angle></spot></light>");
  EXPECT_THAT(Messages(),
              UnorderedElementsAre(HasSubstr("<range> must be above 0; 10 m is used"),
                                   HasSubstr("<outer_angle> <= 2 pi; 1 and 1 rad are used"),
                                   HasSubstr("<outer_angle> <= 2 pi; 0.6 and 0.6 rad are used")));
  ASSERT_EQ(world.lights.size(), 2u);
  EXPECT_EQ(world.lights[0].range, 10);
  EXPECT_EQ(world.lights[1].inner_angle, 0.6);
}

TEST_F(FlawTest, AxisWithoutDirectionAndSwappedLimitsAreRepaired) {
  const std::string link =
      "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
      "</inertial></link>";
  const auto robot =
      Robot("<link name='a'>" + link + "<link name='b'>" + link +
            "<joint name='j' type='revolute'><parent link='a'/><child link='b'/><axis "
            "xyz='0 0 0'/><limit lower='2' upper='-1' effort='1' velocity='1'/></joint>");
  EXPECT_THAT(Messages(),
              UnorderedElementsAre(HasSubstr("has @lower 2 above @upper -1; they are swapped"),
                                   HasSubstr("has no direction; 1 0 0 is used")));
  ASSERT_EQ(robot->joints.size(), 1u);
  EXPECT_EQ(robot->joints[0].position_limits.min, -1);
  EXPECT_EQ(robot->joints[0].position_limits.max, 2);
  EXPECT_EQ(robot->joints[0].axis, (geometry::Vector3{1, 0, 0}));
  World(
      "<model name='m'><link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a"
      "</parent><child>b</child><axis><xyz>0 0 0</xyz></axis></joint></model>");
  EXPECT_THAT(Messages(),
              ElementsAre(HasSubstr(
                  "<xyz> holds \"0 0 0\": an axis needs a length above 0; 0 0 1 is used")));
}

TEST_F(FlawTest, DanglingReferenceIsIgnored) {
  const std::pair<const char*, const char*> contents[] = {
      {"<link name='b'><pose relative_to='nope'>0 0 1 0 0 0</pose></link>", "relative to nope"},
      {"<link name='b'/><frame name='f' attached_to='nope'/>", "attached to nope"},
      {"<link name='b'/><joint name='j' type='fixed'><parent>a</parent><child>nope</child></joint>",
       "\"j\" is ignored: it names nope"},
      {"<link name='b'/><joint name='j' type='fixed'><parent>a</parent><child>a</child></joint>",
       "\"j\" is ignored: its parent and its child are the same"},
      {"<link name='b'/><joint name='j' type='fixed'><child>b</child></joint>", "has no <parent>"},
      {"<link name='b'/><joint name='j' type='hinge'><parent>a</parent><child>b</child></joint>",
       "unknown type \"hinge\"; fixed is used"},
      {"<link name='b'><pose relative_to='c'/></link><link name='c'><pose relative_to='b'/></link>",
       "through other frames"},
      {"<link name='a'/>", "there is a second <link> \"a\"; it is named a_1"},
      {"<link name='world'/>", "is reserved"}};
  for (const auto& [content, part] : contents) {
    const auto world =
        World("<model name='other'><link name='a'/>" + std::string(content) + "</model>");
    ASSERT_THAT(world.models, SizeIs(2)) << content;
    EXPECT_GE(Find(world, "other")->links.size(), 2u) << content;
    EXPECT_EQ(Find(world, "sound")->links[0].model_from_link.position.x, 7) << content;
    EXPECT_THAT(Messages(), Contains(AllOf(HasSubstr("w.sdf:2"), HasSubstr(part)))) << content;
  }
}

TEST_F(FlawTest, ModelWithoutLinksIsSkipped) {
  EXPECT_THAT(World("<model name='empty'/>").models, SizeIs(1));
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("\"empty\" has no links; it is ignored")));
}

TEST_F(FlawTest, LinksThatGazeboClassicFlattenedAreRead) {
  const auto world = World(
      "<model name='row'><link name='left::link'><pose frame=''>1 0 0 0 0 0"
      "</pose><visual name='v'><pose frame=''>0 0 0 0 0 0</pose>" +
          std::string(kCube) + "</visual></link></model>",
      "1.6");
  const model::Model* row = Find(world, "row");
  ASSERT_NE(row, nullptr);
  ASSERT_THAT(row->links, SizeIs(1));
  EXPECT_EQ(row->links[0].model_from_link.position.x, 1);
  EXPECT_THAT(row->links[0].visuals, SizeIs(1));
  Messages();
}

TEST_F(FlawTest, AnInvalidInertiaIsRepairedUnlessTheModelIsStatic) {
  const std::string zero =
      "<link name='l'><inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz>"
      "</inertia></inertial></link></model>";
  EXPECT_THAT(World("<model name='m'><static>true</static>" + zero).models, SizeIs(2));
  EXPECT_THAT(Messages(), IsEmpty());
  const auto world = World("<model name='m'>" + zero);
  EXPECT_EQ(Find(world, "m")->links[0].inertial.mass, 1);
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("1 kg is used")));
}

TEST_F(FlawTest, PrincipalMomentIsAtMostTheSumOfTheOthers) {
  const auto link = [](const std::string& moments) {
    return "<model name='m'><link name='l'><inertial><mass>5</mass><inertia>" + moments +
           "</inertia></inertial></link></model>";
  };
  const auto flat = World(link("<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.9</izz>"));
  EXPECT_NEAR(Find(flat, "m")->links[0].inertial.izz, 0.2, 1e-12);
  EXPECT_NEAR(Find(flat, "m")->links[0].inertial.ixx, 0.1, 1e-12);
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("no body has this inertia")));
  // The same kind of inertia, with the principal moments 0.9, 0.1 and 0.1. The principal axes are
  // rotated by 45° about z.
  const auto turned = World(link("<ixx>0.5</ixx><iyy>0.5</iyy><izz>0.1</izz><ixy>-0.4</ixy>"));
  const model::Inertial& inertial = Find(turned, "m")->links[0].inertial;
  EXPECT_NEAR(inertial.ixx, 0.15, 1e-12);
  EXPECT_NEAR(inertial.iyy, 0.15, 1e-12);
  EXPECT_NEAR(inertial.ixy, -0.05, 1e-12);
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("no body has this inertia")));
  // In real files, a rounded moment may be slightly larger than the sum of the others. Such an
  // inertia is used unchanged.
  const auto rounded = World(link("<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.201</izz>"));
  EXPECT_EQ(Find(rounded, "m")->links[0].inertial.izz, 0.201);
  EXPECT_THAT(Messages(), IsEmpty());
}

TEST_F(FlawTest, AStaticNestedModelDoesNotMove) {
  const std::string shelf = "<model name='shelf'><static>true</static><link name='l'/></model>";
  const auto wrapped = World("<model name='outer'><pose>0 0 2 0 0 0</pose>" + shelf + "</model>");
  EXPECT_TRUE(wrapped.models[1].is_static);
  const auto mixed = World("<model name='outer'><link name='cart'/>" + shelf + "</model>");
  EXPECT_FALSE(mixed.models[1].is_static);
  const model::Model* outer = Find(mixed, "outer");
  ASSERT_THAT(outer->joints, SizeIs(1));
  EXPECT_EQ(outer->joints[0].parent, -1);
  EXPECT_EQ(outer->links[static_cast<std::size_t>(outer->joints[0].child)].name, "shelf::l");
}

TEST_F(FlawTest, AScriptWithoutUriSelectsAMaterialOfGazebo) {
  const auto world = World("<model name='m'><link name='l'><visual name='v'>" + std::string(kCube) +
                           "<material><script><name>Gazebo/Red</name></script></material></visual>"
                           "</link></model>");
  ASSERT_THAT(Find(world, "m")->links[0].visuals, SizeIs(1));
  EXPECT_GT(Find(world, "m")->links[0].visuals[0].materials[0].base_colour.r, 0.9);
  EXPECT_THAT(Messages(), IsEmpty());
}

std::string FlawModel(const std::string& name, const std::string& content,
                      const std::string& version = "1.9") {
  return "<sdf version='" + version + "'><model name='" + name + "'>" + content + "</model></sdf>";
}

std::string IncludeOf(const std::string& uri) {
  return "<include><uri>" + uri + "</uri></include>";
}

TEST_F(FlawTest, IncludesAreFoundFromTheFileThatNamesThemAtAnyDepth) {
  folder_.Write("models/base/model.sdf", FlawModel("base", "<link name='l'/>", "1.6"));
  folder_.Write("models/cart/model.sdf", FlawModel("cart", IncludeOf("model://base"), "1.4"));
  const auto robot =
      folder_.Write("models/robot/model.sdf", FlawModel("robot", IncludeOf("model://cart")));
  const auto model = ModelLibrary().ReadModel(robot.string(), problems_);
  ASSERT_TRUE(model.has_value()) << model.error().Sentence();
  EXPECT_THAT(LinksOf(**model), ElementsAre("cart::base::l"));
  EXPECT_THAT(Messages(), IsEmpty());
}

TEST_F(FlawTest, AFlawInAnIncludedFileIsReportedWithItsPath) {
  folder_.Write("base/model.sdf", FlawModel("base", "\n<link name='l'><pose>1 2 3</pose></link>"));
  folder_.Write("cart/model.sdf",
                FlawModel("cart", "<link name='c'/>" + IncludeOf("model://base")));
  const auto world = World(IncludeOf("model://cart"));
  ASSERT_THAT(world.models, SizeIs(2));
  EXPECT_THAT(LinksOf(*world.models[0].model), UnorderedElementsAre("c", "base::l"));
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("base/model.sdf:2: <pose> holds \"1 2 3\"")));
}

TEST_F(FlawTest, OnlyAnUnreadableIncludeIsOmitted) {
  folder_.Write("walker/model.sdf",
                "<sdf version='1.6'><actor name='w'><skin><filename>w.dae"
                "</filename></skin></actor></sdf>");
  folder_.Write("broken/model.sdf", "<sdf version='1.6'><model name='m'><link");
  for (const char* uri : {"model://absent", "model://broken"}) {
    const auto world = World(IncludeOf(uri) + "<model name='bed'>" + IncludeOf(uri) + "</model>");
    EXPECT_NE(Find(world, "sound"), nullptr) << uri;
    EXPECT_EQ(Find(world, "bed"), nullptr) << uri;
    EXPECT_THAT(Messages(),
                Contains(HasSubstr("the include of " + std::string(uri) + " is ignored")));
  }
  EXPECT_NE(Find(World(IncludeOf("model://walker")), "sound"), nullptr);
}

TEST_F(FlawTest, AModelIsPlacedByItsOwnFrame) {
  folder_.Write("box/model.sdf", FlawModel("box", "<link name='l'/>"));
  const auto world = World(
      "<include><uri>model://box</uri><pose>2 0 0 0 0 0</pose>"
      "<placement_frame>__model__</placement_frame></include>");
  ASSERT_NE(Find(world, "box"), nullptr);
  EXPECT_THAT(Messages(), IsEmpty());
}

TEST_F(FlawTest, LastJointOfALoopClosesItWithoutLimits) {
  const auto joint = [](const std::string& parent, const std::string& child) {
    return "<joint name='" + parent + child + "' type='revolute'><parent>" + parent +
           "</parent><child>" + child +
           "</child><axis><xyz>0 1 0</xyz><limit><lower>-1</lower></limit></axis></joint>";
  };
  const auto model =
      Model("m.sdf", FlawModel("m", "<link name='a'/><link name='b'/><link name='c'/>" +
                                        joint("a", "b") + joint("b", "c") + joint("a", "c")));
  EXPECT_THAT(JointsOf(*model), ElementsAre("ab", "bc"));
  ASSERT_EQ(model->loop_joints.size(), 1u);
  EXPECT_EQ(model->loop_joints[0].name, "ac");
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("\"ac\" closes a loop")));
}

constexpr char kMassive[] =
    "<inertial><mass value='5'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
    "</inertial>";

std::string UrdfLink(const std::string& name, const std::string& content = "") {
  return "<link name='" + name + "'>" + content + "</link>\n";
}

std::string UrdfJoint(const std::string& name, const std::string& type, const std::string& parent,
                      const std::string& child, const std::string& content = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child + "'/>" + content + "</joint>\n";
}

TEST_F(FlawTest, LinksWithoutInertiaKeepTheirJointsShapesAndChildren) {
  const std::string shape = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
  const auto robot =
      Robot(UrdfLink("base", kMassive) + UrdfLink("turret", shape) + UrdfLink("head", kMassive) +
            UrdfJoint("turn", "continuous", "base", "turret") +
            UrdfJoint("nod", "continuous", "turret", "head"));
  EXPECT_THAT(LinksOf(*robot), UnorderedElementsAre("base", "turret", "head"));
  EXPECT_THAT(JointsOf(*robot), UnorderedElementsAre("turn", "nod"));
  EXPECT_THAT(Messages(), ElementsAre(AllOf(HasSubstr("r.urdf:3"), HasSubstr("turret; 0.1 kg"))));
  for (const auto& link : robot->links) {
    if (link.name != "turret") continue;
    EXPECT_THAT(link.visuals, SizeIs(1));
    EXPECT_NEAR(link.inertial.mass, 0.1, 1e-12);
  }
}

TEST_F(FlawTest, ARobotWithoutMassIsRead) {
  const auto robot =
      Robot(UrdfLink("base") + UrdfLink("arm") + UrdfJoint("j", "continuous", "base", "arm"));
  EXPECT_THAT(LinksOf(*robot), UnorderedElementsAre("base", "arm"));
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("2 links have no mass")));
}

TEST_F(FlawTest, LinksFixedToALinkWithMassNeedNoMass) {
  const std::string none =
      "<inertial><mass value='0'/><inertia ixx='0' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/>"
      "</inertial>";
  const auto robot =
      Robot(UrdfLink("base") + UrdfLink("optical", none) + UrdfLink("trunk", kMassive) +
            UrdfJoint("a", "fixed", "base", "optical") + UrdfJoint("b", "fixed", "base", "trunk"));
  ASSERT_FALSE(robot->links.empty());
  EXPECT_NEAR(robot->links[0].inertial.mass, 5, 1e-12);
  EXPECT_THAT(Messages(), IsEmpty());
}

TEST_F(FlawTest, ARobotOnAFloatingJointMovesFreely) {
  const auto robot =
      Robot(UrdfLink("world") + UrdfLink("base", kMassive) + UrdfLink("leg", kMassive) +
            UrdfJoint("float", "floating", "world", "base") +
            UrdfJoint("hip", "continuous", "base", "leg", "<origin xyz='0 0.2 0'/>"));
  EXPECT_THAT(LinksOf(*robot), ElementsAre("base", "leg"));
  EXPECT_THAT(JointsOf(*robot), ElementsAre("hip"));
  EXPECT_NEAR(robot->links[1].model_from_link.position.y, 0.2, 1e-12);
  EXPECT_THAT(Messages(), IsEmpty());
}

TEST_F(FlawTest, AFloatingJointBetweenLinksIsFixed) {
  const auto robot = Robot(UrdfLink("base", kMassive) + UrdfLink("ball", kMassive) +
                           UrdfJoint("float", "floating", "base", "ball"));
  EXPECT_FALSE(robot->links.empty());
  EXPECT_THAT(Messages(), ElementsAre(HasSubstr("\"float\" is fixed")));
}

TEST_F(FlawTest, ScopesInNamesAreReadAsDots) {
  const std::string links =
      "<link name='a::b'/><link name='c'><pose relative_to='a::b'>1 0 0 0 0 0</pose></link>"
      "<joint name='j::k' type='ball'><parent>a::b</parent><child>c</child></joint>";
  for (const char* version : {"1.8", "1.9", "1.11"}) {
    const auto model = Model("scopes.sdf", "<sdf version='" + std::string(version) +
                                               "'><model name='m'>" + links + "</model></sdf>");
    EXPECT_THAT(LinksOf(*model), Contains("a.b")) << version;
    ASSERT_FALSE(model->joints.empty()) << version;
    EXPECT_EQ(model->joints[0].name, "j.k") << version;
    EXPECT_THAT(Messages(), Contains(HasSubstr("the name \"a::b\" contains"))) << version;
  }
}

TEST_F(FlawTest, AnErrorInAUrdfAffectsOnePart) {
  const std::string base = UrdfLink("base", kMassive);
  const auto with = [&](const std::string& content) {
    return UrdfLink("base", kMassive + content);
  };
  const std::pair<std::string, const char*> robots[] = {
      {base + UrdfJoint("j", "continuous", "base", "nope"), "child link \"nope\" does not exist"},
      {base + UrdfLink("lost", kMassive), "no joint connects the link \"lost\""},
      {base + base, "there is one of that name already"},
      {base + UrdfLink("arm", kMassive) + UrdfJoint("j", "revolute", "base", "arm"),
       "it rotates without limits"},
      {base + UrdfLink("arm", kMassive) +
           UrdfJoint("j", "revolute", "base", "arm", "<limit lower='-1' upper='1'/>"),
       "has no @effort"},
      {base + UrdfLink("arm", kMassive) + UrdfJoint("j", "hinge", "base", "arm"),
       "it is read as a fixed joint"},
      {base + UrdfLink("arm", kMassive) +
           UrdfJoint("j", "fixed", "base", "arm", "<origin xyz='0 nan 0'/>"),
       "finite numbers are expected; 0 0 0 is used"},
      {base + UrdfLink("arm", kMassive) +
           UrdfJoint("j", "continuous", "base", "arm", "<dynamics friction='inf'/>"),
       "finite numbers are expected; 0 is used"},
      {UrdfLink("base", "<inertial><mass value='2'/><inertia/></inertial>"),
       "<inertia> has no attributes"},
      {base + UrdfLink("arm", kMassive) +
           UrdfJoint("j", "fixed", "base", "arm", "<origin xyz='0 zero 0'/>"),
       "0 0 0 is used"},
      {with("<visual><geometry/></visual>"), "it has no <geometry> with a shape"},
      {with("<visual><geometry><box size='1 1'/></geometry></visual>"), "its <box> has no @size"},
      {with("<visual><geometry><pyramid/></geometry></visual>"),
       "<pyramid> is not a shape of URDF"},
      {with("<visual><geometry><box size='1 1 1'/></geometry><material name='none'/></visual>"),
       "nothing defines it"},
      {with("<visual><geometry><box size='1 1 1'/></geometry><material name='grey'><color rgba='"
            "127 127 127 255'/></material></visual>"),
       "numbers between 0 and 1"},
      {base + "<material name='m'><color rgba='1 0 0 1'/></material><material name='m'><color "
              "rgba='0 1 0 1'/></material>",
       "there is one of that name already"},
      {UrdfLink("base", "<inertial><inertia ixx='1'/></inertial>"), "it has no mass"}};
  for (const auto& [robot, part] : robots) {
    EXPECT_THAT(Robot(robot)->links, Not(IsEmpty())) << robot;
    EXPECT_THAT(Messages(), Contains(AllOf(HasSubstr("r.urdf:"), HasSubstr(part)))) << robot;
  }
}

TEST_F(FlawTest, ARobotWithoutLinksIsRefusedInOneShortSentence) {
  const auto model = ModelLibrary().ReadModel(
      folder_.Write("r.urdf", "<robot name='r'><!--" + std::string(20'000, 'x') + "--></robot>")
          .string(),
      problems_);
  ASSERT_FALSE(model.has_value());
  EXPECT_THAT(model.error().Sentence(), HasSubstr("r.urdf"));
  EXPECT_LT(model.error().message.size(), 400u);
}

}  // namespace
}  // namespace gsv::formats
