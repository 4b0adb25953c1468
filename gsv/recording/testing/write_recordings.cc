// Writes recordings for interop_test.mjs into a folder:
//   whole.mcap      messages of every type, written through the asynchronous writer
//   recovered.mcap  the recording that is recovered from a truncated copy of whole.mcap
//   run.mcap        two seconds of a simulation: a robot drives from the origin along x at 0.5 m/s
//                   towards a wall whose face is at 2.9 m
// and prints the content of whole.mcap, as `gsv rec info --json` does.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "gsv/messages/sample_filler.h"
#include "gsv/recording/mcap/mcap_writer.h"
#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/reading/recover.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/test_simulation.h"
#include "samples.h"

namespace gsv::recording {
namespace {

constexpr int kRounds = 200;
constexpr base::SimTime kPeriod = std::chrono::milliseconds(10);

std::string TopicOf(const messages::Schema& schema) {
  std::string topic = "/sample/" + std::string(schema.name);
  std::replace(topic.begin() + 1, topic.end(), '/', '_');
  return topic;
}

// Writes kRounds messages of each type. Message number `round` of each type has the time round ·
// kPeriod, and values that depend on `round`.
base::Status WriteSampleMessages(const std::string& path) {
  auto writer = McapWriter::Create(path, {.when_full = WhenFull::kWait});
  if (!writer) return base::Fail(writer.error());
  const std::string world = "<sdf version='1.9'/>";
  (*writer)->AddMetadata({"gsv", {{"seed", "1"}, {"command_line", "gsv run"}}});
  (*writer)->Attach({{}, {}, "world.sdf", "application/xml", std::as_bytes(std::span(world))});
  for (int round = 0; round < kRounds; ++round) {
    messages::ForEachType([&](const messages::Schema& schema, auto message) {
      messages::SampleFiller filler(static_cast<std::uint32_t>(round));
      Fill(message, filler);
      Bytes bytes;
      messages::Encode(message, bytes);
      (*writer)->Write(*(*writer)->AddChannel(TopicOf(schema), schema), round * kPeriod, bytes);
    });
  }
  return (*writer)->Close();
}

base::Status WriteRun(const std::string& path) {
  const auto simulation = MakeSimulation(2s, Drives(0.5));
  RecorderOptions options;
  options.write_glb = [](const model::Model& model) {
    return base::Result<std::vector<std::uint8_t>>(
        std::vector<std::uint8_t>(model.name.begin(), model.name.end()));
  };
  auto recorder = SimulationRecorder::Start(simulation, path, std::move(options));
  if (!recorder) return base::Fail(recorder.error());
  if (RunToEnd(*simulation) != simulation::Phase::kFinished) {
    return base::Fail(base::ErrorCode::kNotRunning, "the simulation did not finish");
  }
  return (*recorder)->Stop();
}

base::Status Run(const std::filesystem::path& folder) {
  const std::string whole = folder / "whole.mcap";
  const std::string cut = folder / "cut.mcap";
  if (base::Status status = WriteSampleMessages(whole); !status) return status;
  const auto info = ReadInfo(whole);
  if (!info) return base::Fail(info.error());
  std::filesystem::copy_file(whole, cut);
  std::filesystem::resize_file(cut, info->size / 2);
  const auto recovery = Recover(cut, folder / "recovered.mcap");
  if (!recovery) return base::Fail(recovery.error());
  if (base::Status status = WriteRun(folder / "run.mcap"); !status) return status;
  std::puts(ToJson(*info).c_str());
  return {};
}

}  // namespace
}  // namespace gsv::recording

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const gsv::base::Status status = gsv::recording::Run(argv[1]);
  if (!status) std::fprintf(stderr, "%s\n", status.error().Sentence().c_str());
  return status ? 0 : 1;
}
