#include <memory>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "gsv/formats/testing/sdf_reader_fixture.h"

namespace gsv::formats {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr char kBox[] =
    "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>";

TEST_F(SdfReaderTest, ReadsTheLocationOfAWorldOnTheEarth) {
  EXPECT_FALSE(World("<world name='w'/>").origin);
  const auto world = World(R"(<world name='w'><magnetic_field>1e-5 2e-5 -3e-5</magnetic_field>
    <spherical_coordinates><surface_model>EARTH_WGS84</surface_model>
      <latitude_deg>45</latitude_deg><longitude_deg>-90</longitude_deg><elevation>12</elevation>
      <heading_deg>180</heading_deg></spherical_coordinates></world>)");
  EXPECT_THAT(problems_, IsEmpty()) << problems_.front().Sentence();
  ExpectNear(world.magnetic_field, {1e-5, 2e-5, -3e-5});
  ASSERT_TRUE(world.origin);
  EXPECT_NEAR(world.origin->latitude, std::numbers::pi / 4, 1e-12);
  EXPECT_NEAR(world.origin->longitude, -std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(world.origin->elevation, 12);
  EXPECT_NEAR(world.origin->heading, std::numbers::pi, 1e-12);
}

TEST_F(SdfReaderTest, WarnsOfARealTimeFactorThatCannotBeUsed) {
  for (const char* factor : {"0", "-1", "2e6"}) {
    const auto world = World(fmt::format(
        "<world name='yard'><physics type='ode'><real_time_factor>{}</real_time_factor></physics>"
        "</world>",
        factor));
    EXPECT_EQ(world.real_time_factor, 1);
    EXPECT_THAT(Sentences(), ::testing::Contains(HasSubstr("<real_time_factor> must lie above 0")));
  }
}

TEST_F(SdfReaderTest, ReadsPhysicsSceneAndLights) {
  const auto world = World(R"(<world name='yard'>
    <physics type='ode'><max_step_size>0.004</max_step_size><real_time_factor>2</real_time_factor></physics>
    <gravity>0 0 -1.6</gravity>
    <scene><ambient>0.1 0.2 0.3 1</ambient><background>0.4 0.5 0.6 1</background><shadows>false</shadows></scene>
    <light name='lamp' type='spot'><pose>1 2 3 0 0 0</pose><diffuse>1 0 0 1</diffuse>
      <direction>0 0 -2</direction><attenuation><range>7</range><linear>0.5</linear></attenuation>
      <spot><inner_angle>0.2</inner_angle><outer_angle>0.4</outer_angle><falloff>1</falloff></spot></light>
    </world>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  EXPECT_EQ(world.name, "yard");
  EXPECT_EQ(world.max_step_size, std::chrono::milliseconds(4));
  EXPECT_EQ(world.real_time_factor, 2);
  EXPECT_EQ(world.gravity, (Vector3{0, 0, -1.6}));
  EXPECT_NEAR(world.scene.background.g, 0.5, 1e-6);
  EXPECT_FALSE(world.scene.shadows);
  ASSERT_THAT(world.lights, SizeIs(1));
  EXPECT_EQ(world.lights[0].kind, model::Light::Kind::kSpot);
  EXPECT_EQ(world.lights[0].direction, (Vector3{0, 0, -1}));
  EXPECT_EQ(world.lights[0].world_from_light.position, (Vector3{1, 2, 3}));
  EXPECT_EQ(world.lights[0].range, 7);
  EXPECT_EQ(world.lights[0].outer_angle, 0.4);
}

TEST_F(SdfReaderTest, GroundPlaneAndSunNeedNoFile) {
  const auto world = World(R"(<world name='w'>
    <include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri></include>
    <include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Sun</uri></include>
    <include><uri>model://ground_plane</uri><name>second</name><pose>0 0 -1 0 0 0</pose></include>
    </world>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT(world.models, SizeIs(2));
  EXPECT_EQ(world.models[0].name, "ground_plane");
  EXPECT_TRUE(world.models[0].is_static);
  EXPECT_EQ(world.models[1].name, "second");
  EXPECT_EQ(world.models[1].world_from_model.position, (Vector3{0, 0, -1}));
  EXPECT_EQ(world.models[0].model, world.models[1].model);
  EXPECT_TRUE(std::holds_alternative<geometry::Plane>(
      world.models[0].model->links.at(0).collisions.at(0).shape));
  ASSERT_THAT(world.lights, SizeIs(1));
  EXPECT_EQ(world.lights[0].kind, model::Light::Kind::kDirectional);
}

TEST_F(SdfReaderTest, ReportsOtherModelsOnTheWebAndContinues) {
  const auto world = World(
      "<world "
      "name='w'>\n<include><uri>https://fuel.gazebosim.org/1.0/x/models/Cone</uri></include>\n"
      "<include><uri>model://nowhere</uri></include></world>");
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("w.sdf:4: the include of https://fuel"));
  EXPECT_EQ(problems_[0].severity, base::Problem::Severity::kWarning);
  EXPECT_THAT(problems_[1].message, HasSubstr("model://nowhere"));
  EXPECT_THAT(world.models, IsEmpty());
}

TEST_F(SdfReaderTest, PlacesIncludesByPoseNameStaticAndFrame) {
  folder_.Write(
      "chair/model.sdf",
      Sdf("<model name='chair'><pose>9 9 9 0 0 0</pose><link name='seat'>" + std::string(kBox) +
          "</link><frame name='foot'><pose>0 0 -0.5 0 0 0</pose></frame></model>"));
  const auto world = World(R"(<world name='w'>
    <include><uri>model://chair</uri></include>
    <include><uri>model://chair</uri><name>a</name><pose>1 2 0 0 0 0</pose><static>true</static></include>
    <include><uri>model://chair</uri><name>b</name><pose>0 0 0 0 0 0</pose><placement_frame>foot</placement_frame></include>
    <include><uri>model://chair</uri><name>c</name><pose relative_to='a'>1 0 0 0 0 0</pose></include>
    <include><uri>chair</uri><name>d</name><pose relative_to='b::foot'>0 0 0 0 0 0</pose></include>
    </world>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT(world.models, SizeIs(5));
  EXPECT_EQ(world.models[0].name, "chair");
  ExpectNear(world.models[0].world_from_model.position, {9, 9, 9});
  ExpectNear(world.models[1].world_from_model.position, {1, 2, 0});
  EXPECT_TRUE(world.models[1].is_static);
  EXPECT_FALSE(world.models[0].is_static);
  ExpectNear(world.models[2].world_from_model.position, {0, 0, 0.5});
  ExpectNear(world.models[3].world_from_model.position, {2, 2, 0});
  ExpectNear(world.models[4].world_from_model.position, {0, 0, 0});
  for (const auto& placed : world.models) EXPECT_EQ(placed.model, world.models[0].model);
}

TEST_F(SdfReaderTest, PlacesAnIncludeByTheFrameThatItsFileNames) {
  folder_.Write(
      "chair/model.sdf",
      Sdf("<model name='chair' placement_frame='foot'><link name='seat'>" + std::string(kBox) +
          "</link><frame name='foot'><pose>0 0 -0.5 0 0 0</pose></frame></model>"));
  const auto world = World(R"(<world name='w'>
    <include><uri>model://chair</uri><pose>1 2 0 0 0 0</pose></include>
    <include><uri>model://chair</uri><name>b</name><pose>1 2 0 0 0 0</pose>
      <placement_frame>__model__</placement_frame></include></world>)");
  ASSERT_THAT(world.models, SizeIs(2));
  ExpectNear(world.models[0].world_from_model.position, {1, 2, 0.5});
  ExpectNear(world.models[1].world_from_model.position, {1, 2, 0});
}

TEST_F(SdfReaderTest, PlacesAFrameRelativeToTheWorldIfItsPoseIs) {
  const auto world = World(
      "<world name='w'><model name='dock'><pose>2 0 0 0 0 1.5</pose><link "
      "name='l'>" +
      std::string(kBox) +
      "</link></model><frame name='f' attached_to='dock'><pose "
      "relative_to='world'>1 0 0 0 0 0</pose></frame><model name='m'><pose "
      "relative_to='f'/><link name='l'>" +
      kBox + "</link></model></world>");
  ASSERT_THAT(world.models, SizeIs(2));
  ExpectNear(world.models[1].world_from_model.position, {1, 0, 0});
}

TEST_F(SdfReaderTest, BuiltInModelsInAModelHaveTheNameAndThePoseOfTheirInclude) {
  const auto world = World(
      "<world name='w'><model name='site'><include><uri>model://ground_plane</uri><name>upper"
      "</name><pose>0 0 3 0 0 0</pose></include><link name='l'>" +
      std::string(kBox) + "</link></model></world>");
  ASSERT_THAT(world.models, SizeIs(1));
  bool is_found = false;
  for (const model::Link& link : world.models[0].model->links) {
    if (!link.name.starts_with("upper::")) continue;
    is_found = true;
    ExpectNear(link.model_from_link.position, {0, 0, 3});
  }
  EXPECT_TRUE(is_found);
}

TEST_F(SdfReaderTest, ALensWithOnlyIntrinsicsHasNoType) {
  const auto lens = [&](const std::string& more) {
    const auto world = World(
        "<world name='w'><model name='m'><link name='l'>" + std::string(kBox) +
        "<sensor name='s' type='camera'><camera><lens>" + more +
        "<intrinsics><fx>554</fx><fy>554</fy><cx>320</cx><cy>240</cy><s>0</s></intrinsics></lens>"
        "</camera></sensor></link></model></world>");
    const model::Parameters& parameters = world.models.at(0).model->sensors.at(0).parameters;
    EXPECT_EQ(model::NumberOr(parameters, "lens.intrinsics.fx", 0), 554);
    return model::TextOr(parameters, "lens.type", "none");
  };
  EXPECT_EQ(lens(""), "none");
  EXPECT_EQ(lens("<type>stereographic</type>"), "stereographic");
}

TEST_F(SdfReaderTest, InlineModelsAreReadOnceAndPlacedByFramesOfTheWorld) {
  std::string content =
      "<world name='w'><frame name='f'><pose>0 0 5 0 0 1.5707963267948966</pose></frame>";
  for (const char* name : {"a", "b"}) {
    content += "<model name='" + std::string(name) +
               "'><pose relative_to='f'>1 0 0 0 0 0</pose><link name='l'>" + kBox +
               "</link></model>";
  }
  const auto world = World(content + "</world>");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT(world.models, SizeIs(2));
  EXPECT_EQ(world.models[0].model, world.models[1].model);
  ExpectNear(world.models[1].world_from_model.position, {0, 1, 5});
}

TEST_F(SdfReaderTest, RenamesTheSecondModelWithTheSameName) {
  const std::string model = "<model name='a'><link name='l'/></model>";
  const auto world = World("<world name='w'>" + model + model + "</world>");
  ASSERT_THAT(world.models, SizeIs(2));
  EXPECT_EQ(world.models[1].name, "a_1");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("a_1"));
}

TEST_F(SdfReaderTest, ReadsTheModelOfAThousandIncludesOnce) {
  folder_.Write("chair/model.sdf",
                Sdf("<model name='chair'><link name='l'>" + std::string(kBox) + "</link></model>"));
  std::string content = "<world name='w'>";
  for (int i = 0; i < 1000; ++i) {
    content += "<include><uri>model://chair</uri><name>c" + std::to_string(i) + "</name><pose>" +
               std::to_string(i) + " 0 0 0 0 0</pose></include>\n";
  }
  const auto world = World(content + "</world>");
  ASSERT_THAT(world.models, SizeIs(1000));
  EXPECT_EQ(world.models[999].world_from_model.position.x, 999);
  std::set<std::shared_ptr<const model::Model>> read;
  for (const auto& placed : world.models) read.insert(placed.model);
  EXPECT_THAT(read, SizeIs(1));
}

TEST_F(SdfReaderTest, FlattensNestedModels) {
  folder_.Write("arm/model.sdf",
                Sdf("<model name='arm'><link name='upper'><pose>1 0 0 0 0 0</pose></link>"
                    "<link name='lower'><pose relative_to='upper'>1 0 0 0 0 0</pose></link>"
                    "<joint name='elbow' type='revolute'><parent>upper</parent><child>lower</child>"
                    "<axis><xyz expressed_in='__model__'>0 1 0</xyz></axis></joint></model>"));
  const auto model = Model(R"(<model name='robot'><link name='base'/>
    <include><uri>model://arm</uri><name>left</name><pose>0 1 0 0 0 1.5707963267948966</pose></include>
    <joint name='mount' type='fixed'><parent>base</parent><child>left::upper</child></joint></model>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT(model->links, SizeIs(3));
  EXPECT_EQ(model->links[1].name, "left::upper");
  ExpectNear(model->links[1].model_from_link.position, {0, 2, 0});
  ExpectNear(model->links[2].model_from_link.position, {0, 3, 0});
  ASSERT_THAT(model->joints, SizeIs(2));
  const model::Joint& elbow = model->joints[1];
  EXPECT_EQ(elbow.name, "left::elbow");
  EXPECT_EQ(elbow.kind, model::JointKind::kContinuous);
  ExpectNear(elbow.axis, {0, 1, 0});  // The axis is in the joint's frame, which is rotated with the
                                      // arm.
  ExpectNear(elbow.model_from_joint.orientation * elbow.axis, {-1, 0, 0});
  EXPECT_EQ(model->joints[0].parent, 0);
  EXPECT_EQ(model->joints[0].child, 1);
}

TEST_F(SdfReaderTest, MergesIncludedModels) {
  folder_.Write(
      "arm/model.sdf",
      Sdf("<model name='arm'><link name='upper'><pose>1 0 0 0 0 0</pose></link></model>"));
  const auto model = Model(
      "<model name='robot'><link name='base'/><include merge='true'>"
      "<uri>model://arm</uri><pose>0 0 2 0 0 0</pose></include></model>");
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT(model->links, SizeIs(2));
  EXPECT_EQ(model->links[1].name, "upper");
  ExpectNear(model->links[1].model_from_link.position, {1, 0, 2});
}

TEST_F(SdfReaderTest, ReadsInertiaSurfaceAndJointLimits) {
  const auto model = Model(R"(<model name='m'><link name='a'>
    <inertial><mass>2</mass><pose>0 0 0.1 0 0 0</pose><inertia><ixx>1</ixx><iyy>2</iyy><izz>2.5</izz><ixy>0.1</ixy></inertia></inertial>
    <collision name='c'><geometry><sphere><radius>0.2</radius></sphere></geometry><surface>
      <friction><ode><mu>0.4</mu><mu2>0.3</mu2></ode></friction><bounce><restitution_coefficient>0.6</restitution_coefficient></bounce></surface></collision>
    </link><link name='b'/><joint name='j' type='prismatic'><parent>a</parent><child>b</child>
    <axis><xyz>0 0 2</xyz><limit><lower>-1</lower><upper>0.5</upper><effort>7</effort><velocity>3</velocity></limit>
    <dynamics><damping>0.2</damping><friction>0.1</friction></dynamics></axis></joint></model>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  const model::Inertial& inertial = model->links[0].inertial;
  EXPECT_EQ(inertial.mass, 2);
  EXPECT_EQ(inertial.link_from_com.position.z, 0.1);
  EXPECT_EQ(inertial.izz, 2.5);
  EXPECT_EQ(inertial.ixy, 0.1);
  const model::Surface& surface = model->links[0].collisions.at(0).surface;
  EXPECT_EQ(surface.friction, 0.4);
  EXPECT_EQ(surface.friction2, 0.3);
  EXPECT_EQ(surface.restitution, 0.6);
  const model::Joint& joint = model->joints.at(0);
  EXPECT_EQ(joint.axis, (Vector3{0, 0, 1}));
  EXPECT_EQ(joint.position_limits.min, -1);
  EXPECT_EQ(joint.position_limits.max, 0.5);
  EXPECT_EQ(joint.effort_limit, 7);
  EXPECT_EQ(joint.velocity_limit, 3);
  EXPECT_EQ(joint.damping, 0.2);
  EXPECT_EQ(joint.friction, 0.1);
}

TEST_F(SdfReaderTest, ReadsEveryShape) {
  const auto model = Model(R"(<model name='m'><link name='l'>
    <collision name='1'><geometry><box><size>1 2 3</size></box></geometry></collision>
    <collision name='2'><geometry><sphere><radius>0.5</radius></sphere></geometry></collision>
    <collision name='3'><geometry><cylinder><radius>0.5</radius><length>2</length></cylinder></geometry></collision>
    <collision name='4'><geometry><capsule><radius>0.5</radius><length>2</length></capsule></geometry></collision>
    <collision name='5'><geometry><ellipsoid><radii>1 2 3</radii></ellipsoid></geometry></collision>
    <collision name='6'><geometry><cone><radius>0.25</radius><length>0.75</length></cone></geometry></collision>
    <collision name='7'><geometry><plane><normal>0 2 0</normal><size>3 4</size></plane></geometry></collision>
    <collision name='8'><geometry><polyline><point>0 0</point><point>1 0</point><point>0 1</point><height>2</height></polyline></geometry></collision>
    <collision name='9'><geometry><empty/></geometry></collision>
    </link></model>)");
  EXPECT_THAT(Sentences(), IsEmpty());
  const auto& collisions = model->links.at(0).collisions;
  ASSERT_THAT(collisions, SizeIs(8));
  EXPECT_EQ(std::get<geometry::Box>(collisions[0].shape).size, (Vector3{1, 2, 3}));
  EXPECT_EQ(std::get<geometry::Capsule>(collisions[3].shape).length, 2);
  EXPECT_EQ(std::get<geometry::Ellipsoid>(collisions[4].shape).radii, (Vector3{1, 2, 3}));
  EXPECT_EQ(std::get<geometry::Cone>(collisions[5].shape).length, 0.75);
  EXPECT_EQ(std::get<geometry::Plane>(collisions[6].shape).normal, (Vector3{0, 1, 0}));
  EXPECT_THAT(std::get<geometry::Mesh>(collisions[7].shape).triangles->triangles, SizeIs(8));
}

constexpr char kTriangleObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(SdfReaderTest, ReadsMeshesByEveryKindOfNameAndSharesThem) {
  folder_.Write("thing/meshes/a.obj", kTriangleObj);
  std::string visuals;
  int i = 0;
  for (const std::string& uri :
       {std::string("meshes/a.obj"), std::string("model://thing/meshes/a.obj"),
        std::string("file://meshes/a.obj"), std::string("meshes\\A.OBJ"),
        "file://" + (folder_.path() / "thing/meshes/a.obj").string()}) {
    visuals += "<visual name='v" + std::to_string(i++) + "'><geometry><mesh><uri>" + uri +
               "</uri><scale>2 2 2</scale></mesh></geometry></visual>";
  }
  folder_.Write("thing/model.sdf",
                Sdf("<model name='thing'><link name='l'>" + visuals + "</link></model>"));
  const auto model = ModelLibrary().ReadModel((folder_.path() / "thing").string(), problems_);
  ASSERT_TRUE(model.has_value());
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT((*model)->links[0].visuals, SizeIs(5));
  const auto& first = std::get<geometry::Mesh>((*model)->links[0].visuals[0].shape);
  EXPECT_EQ(first.scale, (Vector3{2, 2, 2}));
  for (const auto& visual : (*model)->links[0].visuals) {
    EXPECT_EQ(std::get<geometry::Mesh>(visual.shape).triangles, first.triangles);
  }
}

TEST_F(SdfReaderTest, DrawsCollisionShapesWhereAMeshIsAbsent) {
  const std::string mesh = "<geometry><mesh><uri>nowhere.stl</uri></mesh></geometry>";
  const auto model = Model("<model name='m'><link name='l'><visual name='v'>" + mesh +
                           "</visual><visual name='v2'>" + mesh + "</visual>" + kBox +
                           "<collision name='lost'>" + mesh + "</collision></link></model>");
  ASSERT_THAT(model->links.at(0).visuals, SizeIs(1));
  EXPECT_TRUE(std::holds_alternative<geometry::Box>(model->links[0].visuals[0].shape));
  EXPECT_THAT(model->links[0].collisions, SizeIs(1));
  ASSERT_THAT(problems_, SizeIs(3));
  for (const auto& problem : problems_) {
    EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning);
    EXPECT_THAT(problem.Sentence(), HasSubstr("nowhere.stl"));
    EXPECT_THAT(problem.Sentence(), HasSubstr("m.sdf:3: /sdf/model"));
  }
}

TEST_F(SdfReaderTest, ReadsMaterials) {
  folder_.Write("materials/scripts/own.material",
                "material Own/Look { technique { pass { diffuse 0 0 1 1 } } }");
  const auto visual = [](const std::string& name, const std::string& material) {
    return "<visual name='" + name + "'><transparency>" + (name == "glass" ? "0.75" : "0") +
           "</transparency><geometry><box><size>1 1 1</size></box></geometry>" + material +
           "</visual>";
  };
  const auto model = Model(
      "<model name='m'><link name='l'>" + visual("plain", "") +
      visual("glass",
             "<material><diffuse>1 0 0 1</diffuse><emissive>0 0.5 0 1</emissive></material>") +
      visual("gazebo",
             "<material><script><uri>file://media/materials/scripts/gazebo.material</uri>"
             "<name>Gazebo/Green</name></script></material>") +
      visual("own",
             "<material><script><uri>materials/scripts</uri><name>Own/Look</name></script></"
             "material>") +
      visual("metal",
             "<material><pbr><metal><metalness>0.9</metalness><roughness>0.2</roughness></metal></"
             "pbr></material>") +
      "</link></model>");
  EXPECT_THAT(Sentences(), IsEmpty());
  const auto& visuals = model->links.at(0).visuals;
  ASSERT_THAT(visuals, SizeIs(5));
  EXPECT_EQ(visuals[0].materials.at(0).base_colour, model::Material{}.base_colour);
  EXPECT_EQ(visuals[1].materials[0].base_colour, (model::Colour{1, 0, 0, 0.25}));
  EXPECT_EQ(visuals[1].materials[0].emissive.g, 0.5);
  EXPECT_EQ(visuals[2].materials[0].base_colour, (model::Colour{0, 1, 0, 1}));
  EXPECT_EQ(visuals[3].materials[0].base_colour, (model::Colour{0, 0, 1, 1}));
  EXPECT_EQ(visuals[4].materials[0].metalness, 0.9);
  EXPECT_EQ(visuals[4].materials[0].roughness, 0.2);
}

TEST_F(SdfReaderTest, ReadsOcclusionAndLightMaps) {
  // A grey TGA image of one pixel.
  std::string tga(18, '\0');
  tga[2] = 2, tga[12] = tga[14] = 1, tga[16] = 24;
  folder_.Write("map.tga", tga + "\x80\x80\x80");
  const auto visual = [](const std::string& name, const std::string& light) {
    return "<visual name='" + name + "'><geometry><box><size>1 1 1</size></box></geometry>" +
           "<material><pbr><metal><ambient_occlusion_map>map.tga</ambient_occlusion_map>" + light +
           "</metal></pbr></material></visual>";
  };
  const auto model =
      Model("<model name='m'><link name='l'>" + visual("a", "<light_map>map.tga</light_map>") +
            visual("b", "<light_map uv_set='1'>map.tga</light_map>") + "</link></model>");
  const auto& visuals = model->links.at(0).visuals;
  ASSERT_THAT(visuals, SizeIs(2));
  EXPECT_NE(visuals[0].materials.at(0).occlusion_map, nullptr);
  EXPECT_NE(visuals[0].materials[0].light_map, nullptr);
  EXPECT_EQ(visuals[1].materials.at(0).light_map, nullptr);
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("only with texture coordinate set 0")));
}

TEST_F(SdfReaderTest, ReadsTemperaturesOfTheAirAndOfVisuals) {
  EXPECT_EQ(World("<world name='w'/>").temperature, 288.15);
  EXPECT_EQ(World("<world name='w'><atmosphere type='adiabatic'><temperature>300</temperature>"
                  "</atmosphere></world>")
                .temperature,
            300);
  const auto visual = [](const std::string& name, const std::string& more) {
    return "<visual name='" + name + "'><geometry><sphere><radius>1</radius></sphere></geometry>" +
           more + "</visual>";
  };
  const auto warm = [](const std::string& kelvin) {
    return "<plugin filename='gz-sim-thermal-system' name='gz::sim::systems::Thermal'>"
           "<temperature>" +
           kelvin + "</temperature></plugin>";
  };
  const auto model =
      Model("<model name='m'><link name='l'>" + visual("cold", "") + visual("warm", warm("350")) +
            visual("other",
                   "<plugin filename='f' name='gz::sim::systems::Label'>"
                   "<label>10</label></plugin>" +
                       warm("310.5")) +
            visual("wrong", warm("-1")) + "</link></model>");
  ASSERT_THAT(model->links[0].visuals, SizeIs(4));
  EXPECT_EQ(model->links[0].visuals[0].temperature, std::nullopt);
  EXPECT_EQ(model->links[0].visuals[1].temperature, 350);
  EXPECT_EQ(model->links[0].visuals[2].temperature, 310.5);
  EXPECT_EQ(model->links[0].visuals[3].temperature, std::nullopt);
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("the plugin f is not supported"),
                                       HasSubstr("<temperature> must be a number of kelvins")));
}

TEST_F(SdfReaderTest, AModelBecomesAWorldWithSunAndGround) {
  folder_.Write("hall/model.sdf",
                Sdf("<model name='hall'><static>true</static><pose>1 2 0 0 0 0</pose>"
                    "<link name='l'>" +
                    std::string(kBox) + "</link></model>"));
  const auto world = ModelLibrary().ReadWorld(folder_.path() / "hall", problems_);
  ASSERT_TRUE(world.has_value());
  EXPECT_THAT(Sentences(), IsEmpty());
  EXPECT_EQ(world->name, "hall");
  ASSERT_THAT(world->models, SizeIs(2));
  EXPECT_EQ(world->models[0].name, "ground_plane");
  EXPECT_EQ(world->models[1].world_from_model.position, (Vector3{1, 2, 0}));
  EXPECT_THAT(world->lights, SizeIs(1));
}

TEST_F(SdfReaderTest, FindsRobotsByNameAndReadsThemOnce) {
  folder_.Write("lib/rover/model.sdf", Sdf("<model name='rover'><link name='l'/></model>"));
  ReadOptions options;
  options.model_path = {folder_.path() / "lib"};
  ModelLibrary library(options);
  const auto by_name = library.ReadModel("rover", problems_);
  const auto by_folder = library.ReadModel((folder_.path() / "lib/rover").string(), problems_);
  ASSERT_TRUE(by_name.has_value());
  EXPECT_EQ(by_name.value(), by_folder.value());
  const auto beside = ModelLibrary().ReadModel("rover", problems_, folder_.path() / "lib/w.world");
  EXPECT_TRUE(beside.has_value());
  const auto absent = library.ReadModel("no_such_robot", problems_);
  ASSERT_FALSE(absent.has_value());
  EXPECT_EQ(absent.error().code, base::ErrorCode::kBadModel);
  EXPECT_THAT(absent.error().Sentence(), HasSubstr("no_such_robot"));
}

TEST_F(SdfReaderTest, ReadsElementsOfVersionsSince110) {
  for (const char* version : {"1.10", "1.11", "1.12"}) {
    problems_.clear();
    const auto world = World(R"(<world name='w'>
      <light name='off' type='point'><light_on>false</light_on></light>
      <light name='on' type='point'><light_on>true</light_on></light>
      <model name='m'><link name='a'><collision name='c'><geometry><cone><radius>0.2</radius>
        <length>0.6</length></cone></geometry></collision></link><link name='b'/>
        <joint name='j' type='screw'><parent>a</parent><child>b</child>
          <screw_thread_pitch>0.01</screw_thread_pitch>
          <axis><xyz>0 0 1</xyz><limit><lower>-inf</lower><upper>inf</upper></limit></axis></joint>
      </model></world>)",
                             version);
    EXPECT_THAT(Sentences(), IsEmpty()) << version;
    ASSERT_THAT(world.lights, SizeIs(2));
    EXPECT_EQ(world.lights[0].intensity, 0);
    EXPECT_EQ(world.lights[1].intensity, 1);
    ASSERT_THAT(world.models, SizeIs(1));
    const auto& model = *world.models[0].model;
    EXPECT_EQ(std::get<geometry::Cone>(model.links.at(0).collisions.at(0).shape).length, 0.6);
    EXPECT_NEAR(model.joints.at(0).thread_pitch, 0.01 / (2 * std::numbers::pi), 1e-12);
  }
}

TEST_F(SdfReaderTest, ReportsNewUnsupportedElements) {
  (void)World(R"(<world name='w'><model name='m'><link name='a'>
    <inertial><fluid_added_mass><xx>2</xx></fluid_added_mass></inertial></link><link name='b'/>
    <joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>
    <mimic joint='k' axis='axis2'><multiplier>2</multiplier></mimic></axis></joint></model>
    </world>)",
              "1.12");
  EXPECT_THAT(Sentences(), testing::IsSupersetOf({HasSubstr("<fluid_added_mass> is not supported"),
                                                  HasSubstr("attribute \"axis\" of <mimic>")}));
  problems_.clear();
  (void)World("<world name='w'/>", "1.13");
  EXPECT_THAT(Sentences(), ElementsAre(HasSubstr("SDFormat 1.13 is newer than 1.12")));
}

TEST_F(SdfReaderTest, ReportsElementsOfIncludedFilesInTheirFile) {
  folder_.Write("models/box/model.sdf",
                Sdf("<model name='box'><statik>1</statik><link name='l'/></model>"));
  folder_.Write("models/box/model.config",
                "<model><name>box</name><sdf version='1.9'>model.sdf</sdf></model>");
  folder_.Write("models/pair/model.sdf",
                Sdf("<model name='pair'><link name='l'/><include><uri>model://box</uri></include>"
                    "</model>"));
  ReadOptions options;
  options.model_path = {folder_.path() / "models"};
  const auto world = ModelLibrary(options).ReadWorld(
      folder_.Write("w.sdf", Sdf("<world name='w'><include><uri>model://pair</uri></include>"
                                 "</world>")),
      problems_);
  ASSERT_TRUE(world.has_value());
  EXPECT_THAT(Sentences(),
              testing::Contains(testing::AllOf(HasSubstr("box/model.sdf:3: model[box]/statik"),
                                               HasSubstr("Did you mean <static>?"))));
}

TEST_F(SdfReaderTest, ReportsBrokenNamingRulesOnlyOnRequest) {
  const auto file = folder_.Write(
      "rules.sdf", Sdf("<world name='w'><frame name='f' attached_to='nowhere'/></world>"));
  ReadOptions options;
  options.check_rules = true;
  base::Problems problems;
  EXPECT_TRUE(ModelLibrary(options).ReadWorld(file, problems).has_value());
  const auto errors = std::count_if(problems.begin(), problems.end(), [](const auto& each) {
    return each.severity == base::Problem::Severity::kError &&
           each.message.find("its attached_to names") != std::string::npos;
  });
  EXPECT_EQ(errors, 1);
  problems.clear();
  EXPECT_TRUE(ModelLibrary().ReadWorld(file, problems).has_value());
  for (const auto& each : problems) EXPECT_NE(each.severity, base::Problem::Severity::kError);
}

}  // namespace
}  // namespace gsv::formats
