#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/limit_option.h"
#include "gsv/base/atomic_file.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/urdf/urdf_writer.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string model, format, output;
  std::vector<std::string> model_path;
  formats::ReadLimits limits;
};

// Returns the folder of the meshes, which is beside the file: courier.urdf has courier_meshes/.
std::string MeshFolderOf(const fs::path& output) {
  return output.empty() ? "meshes/" : output.stem().string() + "_meshes/";
}

base::Status WriteFiles(const formats::Urdf& urdf, const fs::path& output) {
  if (output.empty()) {
    if (urdf.meshes.empty()) {
      std::fputs(urdf.text.c_str(), stdout);
      return {};
    }
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the model has meshes, which are written as files. Use --output FILE");
  }
  if (!urdf.meshes.empty()) {
    const fs::path folder = output.parent_path() / MeshFolderOf(output);
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "cannot create the folder: " + error.message(), folder.string());
    }
    for (const formats::UrdfMesh& mesh : urdf.meshes) {
      const auto written =
          base::WriteAtomically(folder / mesh.file, mesh.stl, base::Durability::kProcess);
      if (!written) return written;
    }
  }
  return base::WriteAtomically(output, urdf.text, base::Durability::kProcess);
}

base::Status Convert(const ConvertArguments& arguments) {
  formats::ReadOptions options;
  options.limits = arguments.limits;
  options.model_path.assign(arguments.model_path.begin(), arguments.model_path.end());
  base::Problems problems = CheckModelPath(arguments.model_path);
  const auto model = formats::ModelLibrary(std::move(options)).ReadModel(arguments.model, problems);
  if (!model) return base::Fail(model.error());
  const formats::Urdf urdf = formats::WriteUrdf(**model, MeshFolderOf(arguments.output), problems);
  for (const base::Problem& problem : problems) {
    std::fprintf(stderr, "warning: %s\n", problem.Sentence().c_str());
  }
  return WriteFiles(urdf, arguments.output);
}

}  // namespace

void AddConvertCommand(const CommandLine& line) {
  CLI::App* command = line.app.get_subcommand("model")->add_subcommand(
      "convert", "Write a model of any format as URDF");
  auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("model", arguments->model, "model file, folder or name")
      ->type_name("MODEL")
      ->required();
  command->add_option("--to", arguments->format, "format to write")
      ->check(OneOf({"urdf"}))
      ->type_name("urdf")
      ->required();
  command->add_option("-o,--output", arguments->output, "file to write (default: standard output)")
      ->type_name("FILE");
  command->add_option("--model-path", arguments->model_path, "folder to search for models")
      ->type_name("FOLDER");
  AddLimitOption(*command, arguments->limits);
  command->callback([arguments, line] {
    if (const auto converted = Convert(*arguments); !converted) {
      line.exit_code = PrintError(converted.error());
    }
  });
}

}  // namespace gsv::app
