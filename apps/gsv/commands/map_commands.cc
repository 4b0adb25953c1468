#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/limit_option.h"
#include "gsv/base/atomic_file.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/reality/maps/map_world.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

void PrintWarnings(const base::Problems& problems) {
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "gsv: warning: %s\n", problem.Sentence().c_str());
  }
}

struct FromMapArguments {
  std::string map, world;
  double height = 1;
};

int FromMap(const FromMapArguments& arguments) {
  base::Problems problems;
  const auto map = fs::path(arguments.map).extension() == ".dat"
                       ? reality::ReadBeesoftMap(arguments.map)
                       : reality::ReadMap(arguments.map, problems);
  PrintWarnings(problems);
  if (!map) return PrintError(map.error());
  fs::path file = arguments.world;
  if (file.empty()) file = fs::path(arguments.map).replace_extension(".sdf");
  const auto sdf = reality::WorldOfMap(*map, file.stem().string(), arguments.height);
  if (!sdf) return PrintError(sdf.error());
  if (auto ok = base::WriteAtomically(file, *sdf, base::Durability::kProcess); !ok) {
    return PrintError(ok.error());
  }
  std::printf("%s: %g by %g m, walls of %zu boxes\n", file.c_str(), map->width * map->resolution,
              map->height * map->resolution, reality::BoxesOf(*map).size());
  return kOk;
}

struct ToMapArguments {
  std::string world, map;
  std::vector<std::string> model_path;
  reality::SliceOptions slice;
  formats::ReadLimits limits;
};

int ToMap(const ToMapArguments& arguments) {
  const auto found = FindWorld(arguments.world);
  if (!found) return PrintError(found.error());
  formats::ReadOptions options;
  options.limits = arguments.limits;
  options.model_path.assign(arguments.model_path.begin(), arguments.model_path.end());
  formats::ModelLibrary library(std::move(options));
  base::Problems problems = CheckModelPath(arguments.model_path);
  const auto world = library.ReadWorld(*found, problems);
  if (!world) return PrintError(world.error());
  const auto map = reality::MapOfWorld(*world, arguments.slice);
  if (!map) return PrintError(map.error());
  fs::path file = arguments.map;
  if (file.empty()) file = fs::path(*found).stem().string() + ".yaml";
  if (auto ok = reality::WriteMap(*map, file); !ok) return PrintError(ok.error());
  std::printf("%s: %d by %d cells of %g m\n", file.c_str(), map->width, map->height,
              map->resolution);
  return kOk;
}

}  // namespace

void AddMapCommands(const CommandLine& line) {
  CLI::App* const group = line.app.get_subcommand("world");
  CLI::App* from = group->add_subcommand("from-map", "Make a world from an occupancy map");
  auto source = std::make_shared<FromMapArguments>();
  from->add_option("map", source->map, "map_server's YAML file, or a map of CMU's .dat format")
      ->required();
  from->add_option("world", source->world, "the world file to write (default: MAP.sdf)");
  from->add_option("--height", source->height, "height of the walls, m")
      ->capture_default_str()
      ->check(Between(0.01, 100.0));
  from->callback([source, line] { line.exit_code = FromMap(*source); });

  CLI::App* to = group->add_subcommand("to-map", "Make an occupancy map of a world");
  auto target = std::make_shared<ToMapArguments>();
  to->add_option("world", target->world, "file, folder or name of the world")->required();
  to->add_option("map", target->map,
                 "the YAML file to write, with a PGM beside it (default: WORLD.yaml)");
  to->add_option("--resolution", target->slice.resolution, "cell size, m")
      ->capture_default_str()
      ->check(Between(1e-3, 100.0));
  to->add_option("--height", target->slice.height,
                 "height of the horizontal section through the world, m")
      ->capture_default_str()
      ->check(Between(-1e4, 1e4));
  to->add_option("--margin", target->slice.margin, "margin of free cells around the world, m")
      ->capture_default_str()
      ->check(Between(0.0, 1e3));
  to->add_option("--model-path", target->model_path, "folder to search for models");
  AddLimitOption(*to, target->limits);
  to->callback([target, line] { line.exit_code = ToMap(*target); });
}

}  // namespace gsv::app
