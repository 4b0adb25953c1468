#include <cmath>
#include <cstdio>
#include <optional>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/camera_options.h"
#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/running/film.h"
#include "apps/gsv/running/recorded_images.h"
#include "gsv/base/counted.h"

namespace gsv::app {
namespace {

constexpr double kMaxFilmFrames = 1'000'000;

struct FilmArguments {
  std::string file;
  FilmOptions film;
  std::optional<double> from, to;
  double speed = 1;
  view::Camera camera;
};

base::Result<std::uint64_t> FramesOf(const FilmArguments& arguments, base::SimTime from,
                                     base::SimTime to) {
  if (to < from) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "--to must not be before --from");
  }
  const double frames =
      1 + std::floor(base::ToSeconds(to - from) / arguments.speed * arguments.film.frames_a_second +
                     1e-6);
  if (frames <= kMaxFilmFrames) return static_cast<std::uint64_t>(frames);
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "the film would have more than 1,000,000 frames; select a part with --from and "
                    "--to, or use a smaller --fps");
}

// Frame number i shows the recorded time `from + i * speed / frames_a_second`.
int MakeFilm(const FilmArguments& arguments, Signals& signals) {
  if (auto ok = view::Check(arguments.camera); !ok) return RefuseImage(ok.error());
  const auto images = RecordedImages::Open(arguments.file);
  if (!images) return RefuseImage(images.error());
  const base::SimTime from =
      arguments.from ? base::FromSeconds(*arguments.from) : (*images)->start();
  const base::SimTime to = arguments.to ? base::FromSeconds(*arguments.to) : (*images)->end();
  for (const base::SimTime time : {from, to}) {
    if (auto ok = (*images)->Check(time); !ok) return RefuseImage(ok.error());
  }
  const auto frames = FramesOf(arguments, from, to);
  if (!frames) return RefuseImage(frames.error());
  FilmOptions options = arguments.film;
  options.frames = *frames;
  options.width = arguments.camera.width;
  options.height = arguments.camera.height;
  const auto film = Film::Start(options);
  if (!film) return RefuseImage(film.error());
  const double seconds_a_frame = arguments.speed / options.frames_a_second;
  for (std::uint64_t i = 0; i < *frames; ++i) {
    if (signals.WaitFor(0) != 0) return kInterrupted;
    const auto time = from + base::FromSeconds(static_cast<double>(i) * seconds_a_frame);
    const auto image = (*images)->Draw(time, arguments.camera);
    if (!image) return RefuseImage(image.error());
    if (auto added = (*film)->Add(**image); !added) return RefuseImage(added.error());
  }
  if (auto finished = (*film)->Finish(); !finished) return RefuseImage(finished.error());
  std::printf("%s: %s, %.3f s\n", options.output.c_str(), base::Counted(*frames, "frame").c_str(),
              static_cast<double>(*frames) / options.frames_a_second);
  return kOk;
}

}  // namespace

void AddFilmCommand(const CommandLine& line) {
  CLI::App* command =
      line.app.add_subcommand("film", "Make a video of a recording, without a browser");
  auto arguments = std::make_shared<FilmArguments>();
  command->add_option("file", arguments->file, "recording: file NAME.mcap or folder NAME")
      ->required();
  command
      ->add_option("-o,--output", arguments->film.output,
                   "film to write: .webm, .mp4 (both with ffmpeg), .apng, or a new folder of PNGs")
      ->type_name("FILE")
      ->required()
      ->check(CheckFilmName);
  command
      ->add_option("--from", arguments->from,
                   "first simulated time (default: the start of the recording)")
      ->type_name("SECONDS")
      ->check(Between(-9e9, 9e9));
  command
      ->add_option("--to", arguments->to, "last simulated time (default: the end of the recording)")
      ->type_name("SECONDS")
      ->check(Between(-9e9, 9e9));
  command->add_option("--fps", arguments->film.frames_a_second, "frames per second of the film")
      ->type_name("HZ")
      ->check(Between(0.1, 240.0))
      ->capture_default_str();
  command->add_option("--speed", arguments->speed, "recorded seconds per second of the film")
      ->type_name("F")
      ->check(Between(0.001, 1000.0))
      ->capture_default_str();
  AddCameraOptions(*command, arguments->camera);
  command->callback([arguments, line] { line.exit_code = MakeFilm(*arguments, line.signals); });
}

}  // namespace gsv::app
