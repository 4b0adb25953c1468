#include "gsv/reality/maps/occupancy_map.h"

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/reality/maps/map_world.h"

namespace gsv::reality {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kYaml = "image: map.pgm\nresolution: 0.5\norigin: [-1, 2, 0]\n";

class OccupancyMapTest : public testing::Test {
 protected:
  OccupancyMap Read(const std::string& yaml, const std::string& image) {
    folder_.Write("map.pgm", image);
    auto map = ReadMap(folder_.Write("map.yaml", yaml), problems_);
    EXPECT_TRUE(map) << map.error().Sentence();
    return map ? *map : OccupancyMap();
  }
  std::string Refusal(const std::string& yaml, const std::string& image) {
    if (!image.empty()) folder_.Write("map.pgm", image);
    auto map = ReadMap(folder_.Write("map.yaml", yaml), problems_);
    EXPECT_FALSE(map);
    return map ? "" : map.error().Sentence();
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(OccupancyMapTest, HasTheImagesLastRowAtTheBottom) {
  const OccupancyMap map = Read(kYaml, "P2\n# a comment\n3 2\n255\n0 254 254\n254 205 0\n");
  EXPECT_EQ(map.width, 3);
  EXPECT_EQ(map.origin_y, 2);
  EXPECT_THAT(map.cells, ElementsAre(Cell::kFree, Cell::kUnknown, Cell::kOccupied,  //
                                     Cell::kOccupied, Cell::kFree, Cell::kFree));
}

TEST_F(OccupancyMapTest, ReadsNegatedAndRawMaps) {
  EXPECT_EQ(Read(std::string(kYaml) + "negate: 1\n", "P2 2 1 255 255 0").at(0, 0), Cell::kOccupied);
  // In the mode raw of map_server, values are percentages, and values above 100 mean unknown.
  const OccupancyMap raw = Read(std::string(kYaml) + "mode: raw\n", "P2 3 1 255 100 0 255");
  EXPECT_THAT(raw.cells, ElementsAre(Cell::kOccupied, Cell::kFree, Cell::kUnknown));
}

TEST_F(OccupancyMapTest, RejectsFilesThatAreNotMaps) {
  EXPECT_THAT(Refusal(kYaml, ""), HasSubstr("map.pgm: no such file"));
  EXPECT_THAT(Refusal(kYaml, "P5\n3 2\n255\nab"),
              HasSubstr("the PGM is cut off: it has 2 of 6 pixels"));
  EXPECT_THAT(Refusal(kYaml, "P5 1000000 1000000 255 "),
              HasSubstr("each side must have 1 to 16384"));
  EXPECT_THAT(Refusal("P5\n3 2\n255\n", "P5"), HasSubstr("name its YAML file instead"));
  EXPECT_THAT(Refusal("image: map.pgm\nresolution: 0\n", "P2 1 1 255 0"),
              HasSubstr("resolution is 0"));
  EXPECT_THAT(Refusal(std::string(kYaml) + "free_thresh: 0.9\n", "P2 1 1 255 0"),
              HasSubstr("free_thresh is 0.9 and occupied_thresh is 0.65; 0 <= free_thresh <= "
                        "occupied_thresh <= 1 is required"));
  EXPECT_THAT(Refusal(std::string(kYaml) + "occupied_thresh: many\n", "P2 1 1 255 0"),
              HasSubstr("occupied_thresh must be a number"));
  EXPECT_THAT(Refusal("image: [\n", "P2 1 1 255 0"), HasSubstr("map.yaml: line "));
  EXPECT_THAT(Refusal("image: map.pgm\nresolution: .nan\n", "P2 1 1 255 0"),
              HasSubstr("resolution is nan"));
}

TEST_F(OccupancyMapTest, WarnsOfAMapThatIsMostlyWall) {
  Read(kYaml, "P2 2 1 255 0 0");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("2 of 2 cells are occupied; check negate"));
}

TEST_F(OccupancyMapTest, ReadsCellsByColumnOfTheTextFormat) {
  const auto map = ReadBeesoftMap(folder_.Write(
      "a.dat", "robot_specifications->resolution 20\nglobal_map[0]: 2 2\n0 1\n-1 0.9\n"));
  ASSERT_TRUE(map) << map.error().Sentence();
  EXPECT_EQ(map->resolution, 0.2);
  EXPECT_EQ(map->at(0, 0), Cell::kOccupied);
  EXPECT_EQ(map->at(0, 1), Cell::kFree);
  EXPECT_EQ(map->at(1, 0), Cell::kUnknown);
}

TEST_F(OccupancyMapTest, JoinsCellsToBoxes) {
  const OccupancyMap map = Read(kYaml, "P2 3 3 255 0 0 0 0 254 254 0 254 254");
  const std::vector<CellBox> boxes = BoxesOf(map);
  ASSERT_THAT(boxes, SizeIs(2));
  EXPECT_EQ(boxes[0].height, 2);
  EXPECT_EQ(boxes[1].width, 3);
}

TEST_F(OccupancyMapTest, IsRecoveredFromTheWorldThatItMakes) {
  OccupancyMap map;
  map.width = 6, map.height = 5, map.resolution = 0.5, map.origin_x = -1.5, map.origin_y = 1;
  map.cells.assign(30, Cell::kFree);
  for (int x = 0; x < 6; ++x) map.cells[12 + x] = Cell::kOccupied;
  map.cells[1] = map.cells[22] = Cell::kOccupied;
  const auto sdf = WorldOfMap(map, "a map", 1);
  ASSERT_TRUE(sdf) << sdf.error().Sentence();
  formats::ModelLibrary library;
  const auto world = library.ReadWorld(folder_.Write("map.sdf", *sdf), problems_);
  ASSERT_TRUE(world) << world.error().Sentence();
  EXPECT_THAT(problems_, IsEmpty());
  const auto back = MapOfWorld(*world, {0.5, 0.2, 0.5});
  ASSERT_TRUE(back) << back.error().Sentence();
  int occupied = 0;
  for (int y = 0; y < back->height; ++y) {
    for (int x = 0; x < back->width; ++x) {
      if (back->at(x, y) != Cell::kOccupied) continue;
      ++occupied;
      const int map_x = x + static_cast<int>((back->origin_x - map.origin_x) / 0.5);
      const int map_y = y + static_cast<int>((back->origin_y - map.origin_y) / 0.5);
      EXPECT_EQ(map.at(map_x, map_y), Cell::kOccupied) << map_x << ' ' << map_y;
    }
  }
  EXPECT_EQ(occupied, 8);
  for (const char* height : {"3", "-1"}) {  // above and below the walls
    EXPECT_THAT(MapOfWorld(*world, {0.5, std::atof(height), 0.5}).error().Sentence(),
                HasSubstr(std::string("there is nothing in the world at a height of ") + height));
  }
  EXPECT_THAT(MapOfWorld(*world, {1e-4, 0.2, 0.5}).error().Sentence(),
              HasSubstr("choose a coarser --resolution"));
}

TEST_F(OccupancyMapTest, IsWrittenAsMapServerReadsIt) {
  const OccupancyMap map = Read(kYaml, "P2 3 2 255 0 254 254 254 205 0");
  ASSERT_TRUE(WriteMap(map, folder_.path() / "copy.yaml"));
  const auto copy = ReadMap(folder_.path() / "copy.yaml", problems_);
  ASSERT_TRUE(copy) << copy.error().Sentence();
  EXPECT_EQ(copy->cells, map.cells);
  EXPECT_EQ(copy->origin_x, -1);
}

}  // namespace
}  // namespace gsv::reality
