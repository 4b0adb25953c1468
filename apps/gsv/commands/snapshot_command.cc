#include <cstdio>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/camera_options.h"
#include "apps/gsv/commands/commands.h"
#include "apps/gsv/commands/selection_options.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/image_file.h"
#include "apps/gsv/running/recorded_images.h"
#include "gsv/base/log.h"
#include "gsv/gateway/upstream/fetch.h"

namespace gsv::app {
namespace {

struct SnapshotArguments {
  std::string output, token, authority;
  Selection selection;  // its member `simulation` may also be the file of a recording
  std::optional<double> at;
  view::Camera camera;
};

int DrawRecording(const SnapshotArguments& arguments) {
  const auto images = RecordedImages::Open(arguments.selection.simulation);
  if (!images) return RefuseImage(images.error());
  const base::SimTime time = arguments.at ? base::FromSeconds(*arguments.at) : (*images)->end();
  if (auto ok = (*images)->Check(time); !ok) return RefuseImage(ok.error());
  const auto image = (*images)->Draw(time, arguments.camera);
  if (!image) return RefuseImage(image.error());
  if (auto written = WriteImage(**image, arguments.output); !written) {
    return RefuseImage(written.error());
  }
  std::printf("%s: %d x %d pixels, at %.3f s\n", arguments.output.c_str(), (*image)->width,
              (*image)->height, base::ToSeconds(time));
  return kOk;
}

std::string TargetOf(const SnapshotArguments& arguments, const std::string& simulation) {
  const view::Camera& camera = arguments.camera;
  const bool is_png = arguments.output.ends_with(".png");
  std::string target = fmt::format("/view.{}?simulation={}&size={}x{}", is_png ? "png" : "jpg",
                                   gateway::Escape(simulation), camera.width, camera.height);
  const auto add_point = [&](const char* name, const std::optional<geometry::Vector3>& point) {
    if (point) target += fmt::format("&{}={},{},{}", name, point->x, point->y, point->z);
  };
  add_point("eye", camera.eye);
  add_point("target", camera.target);
  if (!camera.follow.empty()) target += "&follow=" + gateway::Escape(camera.follow);
  if (!camera.sensor.empty()) target += "&camera=" + gateway::Escape(camera.sensor);
  if (camera.field_of_view) target += fmt::format("&fov={}", *camera.field_of_view);
  return target;
}

// Returns the sentence that a server sent instead of an image.
base::Error RefusalOf(const gateway::Response& response) {
  const auto json = nlohmann::json::parse(response.body.view(), nullptr, false);
  const auto sentence = json.is_object() ? json.find("error") : json.end();
  const bool has_sentence = json.is_object() && sentence != json.end() && sentence->is_string();
  const auto code = response.status == 400   ? base::ErrorCode::kInvalidArgument
                    : response.status == 404 ? base::ErrorCode::kNotFound
                                             : base::ErrorCode::kUnavailable;
  return {code,
          has_sentence ? sentence->get<std::string>()
                       : fmt::format("the server answered with the status {}; its version of GSV "
                                     "may be too old to draw images",
                                     response.status),
          {}};
}

// Lets the server of the simulation render the current instant.
int DrawSimulation(const SnapshotArguments& arguments) {
  if (arguments.at) {
    return RefuseImage({base::ErrorCode::kInvalidArgument,
                        "selects an instant of a recording; a running simulation is drawn as it is "
                        "now",
                        "--at"});
  }
  const auto found = FindOneSimulation(arguments.selection);
  if (!found) return RefuseImage(found.error());
  if (found->server.viewer_url.empty()) {
    return RefuseImage({base::ErrorCode::kUnavailable,
                        "cannot be drawn: it runs without a viewer. Start it without --headless",
                        found->server.Describe()});
  }
  auto address = gateway::upstream::ParseAddress(found->server.viewer_url, arguments.authority);
  if (!address) return RefuseImage(address.error());
  address->token = arguments.token;
  gateway::Request request;
  request.method = "GET";
  request.raw_target = TargetOf(arguments, found->status.name);
  const auto response = gateway::upstream::Fetch(*address, request, std::chrono::seconds(60));
  if (!response) return RefuseImage(response.error());
  if (response->status != 200) return RefuseImage(RefusalOf(*response));
  if (auto ok = WriteImageFile(response->body.view(), arguments.output); !ok) {
    return RefuseImage(ok.error());
  }
  std::printf("%s: %d x %d pixels, of %s\n", arguments.output.c_str(), arguments.camera.width,
              arguments.camera.height, found->status.name.c_str());
  return kOk;
}

int TakeSnapshot(const SnapshotArguments& arguments) {
  if (auto ok = view::Check(arguments.camera); !ok) return RefuseImage(ok.error());
  const std::string& source = arguments.selection.simulation;
  std::error_code ignored;
  const bool is_file = source.ends_with(".mcap") || source.find('/') != std::string::npos ||
                       std::filesystem::exists(source, ignored);
  return is_file ? DrawRecording(arguments) : DrawSimulation(arguments);
}

}  // namespace

void AddSnapshotCommand(const CommandLine& line) {
  CLI::App* command = line.app.add_subcommand(
      "snapshot", "Draw an image of a recording or a running simulation, without a browser");
  auto arguments = std::make_shared<SnapshotArguments>();
  command->add_option(
      "source", arguments->selection.simulation,
      "recording (NAME.mcap or folder), or simulation (default: that of your newest instance)");
  command->add_option("-o,--output", arguments->output, "image to write, .jpg, .jpeg or .png")
      ->type_name("FILE")
      ->required()
      ->check(CheckImageName);
  command
      ->add_option("--at", arguments->at,
                   "simulated time in a recording (default: the end of the recording)")
      ->type_name("SECONDS")
      ->check(Between(-9e9, 9e9));
  AddCameraOptions(*command, arguments->camera);
  AddInstanceOptions(*command, arguments->selection);
  command->add_option("--token", arguments->token, "control or watch token of the server")
      ->type_name("TOKEN")
      ->envname("GSV_TOKEN");
  command
      ->add_option("--authority", arguments->authority,
                   "certificate authority of the server, PEM (default: the system's)")
      ->type_name("FILE");
  command->callback([arguments, line] {
    base::RedactInLog(arguments->token);
    line.exit_code = TakeSnapshot(*arguments);
  });
}

}  // namespace gsv::app
