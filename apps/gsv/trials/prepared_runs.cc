#include "apps/gsv/trials/prepared_runs.h"

#include <nlohmann/json.hpp>

#include "apps/gsv/machine/installation.h"

namespace gsv::app {
namespace {

// the size of the memory for a run's command line, which `ps` shows
constexpr std::size_t kTitleBytes = 4096;

}  // namespace

base::Status PreparedRuns::Start(const std::vector<std::string>& arguments,
                                 const std::filesystem::path& output,
                                 const std::filesystem::path& errors) {
  if (server_ == nullptr) {
    auto server = ChildProcess::Start({ProgramPath(), "run-server", std::string(kTitleBytes, '-')},
                                      false, ChildProcess::Input::kOpen);
    if (!server) return base::Fail(server.error());
    server_ = *std::move(server);
  }
  const nlohmann::json request{
      {"arguments", arguments}, {"stdout", output.string()}, {"stderr", errors.string()}};
  auto ok = server_->Write(request.dump() + "\n");
  if (!ok) server_.reset();
  return ok;
}

std::string PreparedRuns::AwaitEnd(std::chrono::milliseconds timeout) {
  if (server_ == nullptr) return "no process";
  if (auto line = server_->ReadLine(timeout)) return *line;
  const std::string ending = server_->Ending();
  if (!ending.empty()) server_.reset();
  return ending;
}

}  // namespace gsv::app
