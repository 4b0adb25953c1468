#include "tests/support/programs.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace gsv::testing {
namespace {

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

fs::path Program(const std::string& name) {
  const char* build = std::getenv("GSV_BUILD_DIR");
  return fs::path(build != nullptr ? build : ".") / "bin" / name;
}

fs::path RealFile(const std::string& path) {
  const char* real = std::getenv("GSV_REAL_DIR");
  return fs::path(real != nullptr ? real : "") / path;
}

nlohmann::json Outcome::LastLine() const {
  const std::size_t end = out.find_last_not_of('\n');
  if (end == std::string::npos) return {};
  const std::size_t start = out.rfind('\n', end);
  return nlohmann::json::parse(out.substr(start == std::string::npos ? 0 : start + 1), nullptr,
                               false);
}

Running::Running(const std::string& program, std::vector<std::string> arguments,
                 const std::vector<std::string>& wrapper) {
  std::vector<std::string> command{"/bin/sh", "-c", "exec \"$@\" 2>\"$0\"",
                                   (folder_.path() / "stderr").string()};
  command.insert(command.end(), wrapper.begin(), wrapper.end());
  command.push_back(Program(program).string());
  command.insert(command.end(), arguments.begin(), arguments.end());
  auto process = app::ChildProcess::Start(std::move(command), false);
  if (!process) throw std::runtime_error(process.error().Sentence());
  process_ = *std::move(process);
}

std::string Running::AwaitLine(const std::string& text) {
  while (const auto line = process_->ReadLine(kProgramTimeout)) {
    out_ += *line + "\n";
    if (line->find(text) != std::string::npos) return *line;
  }
  ADD_FAILURE() << "never said \"" << text << "\"; stdout: " << out_ << "stderr: " << errors();
  return {};
}

Outcome Running::AwaitEnd() {
  while (const auto line = process_->ReadLine(kProgramTimeout)) out_ += *line + "\n";
  Outcome outcome;
  outcome.ending = process_->AwaitEnd(kProgramTimeout);
  outcome.out = out_;
  outcome.err = errors();
  return outcome;
}

std::string Running::errors() const { return ReadFile(folder_.path() / "stderr"); }

Outcome RunProgram(const std::string& program, std::vector<std::string> arguments) {
  return Running(program, std::move(arguments)).AwaitEnd();
}

std::string HttpGet(const std::string& url) {
  const std::size_t host = std::string("http://127.0.0.1:").size();
  const std::size_t slash = url.find('/', host);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(host, slash - host))));
  const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval timeout{30, 0};
  setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  std::string answer;
  if (connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
    const std::string request = "GET " + url.substr(slash) +
                                " HTTP/1.1\r\nHost: 127.0.0.1:" + url.substr(host, slash - host) +
                                "\r\nConnection: close\r\n\r\n";
    (void)!write(connection, request.data(), request.size());
    char bytes[4096];
    for (ssize_t n; (n = read(connection, bytes, sizeof bytes)) > 0;)
      answer.append(bytes, static_cast<std::size_t>(n));
  }
  close(connection);
  const std::size_t body = answer.find("\r\n\r\n");
  return body == std::string::npos ? "" : answer.substr(body + 4);
}

BrokerProcess::BrokerProcess(const std::string& address)
    : process_("gsv", {"broker", "--listen", address, "--port", "0", "--memory"}) {
  reference_ = process_.AwaitLine("corbaloc");
}

}  // namespace gsv::testing
