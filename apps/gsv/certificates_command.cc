// gsv certificates: a small authority, and certificates that it has signed.
#include <unistd.h>

#include <array>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands.h"
#include "apps/gsv/exit_code.h"
#include "gsv/tls/certificates.h"

namespace gsv::app {
namespace {

struct CertificatesArguments {
  std::string folder, name = "server";
  std::vector<std::string> hosts;
  int days = 365;
};

tls::Validity ValidityOf(int days) {
  tls::Validity validity;
  validity.ends = std::chrono::hours(24 * days);
  return validity;
}

// Names under which a server is called if nothing else is said.
std::vector<std::string> UsualHosts() {
  std::array<char, 256> name{};
  std::vector<std::string> hosts{"localhost", "127.0.0.1", "::1"};
  if (gethostname(name.data(), name.size() - 1) == 0) hosts.emplace_back(name.data());
  return hosts;
}

base::Status MakeCertificates(const CertificatesArguments& arguments) {
  if (!tls::HasAuthority(arguments.folder)) {
    // It outlives what it signs.
    constexpr int kTimesAsLong = 10;
    if (auto ok = tls::MakeAuthority(arguments.folder, ValidityOf(kTimesAsLong * arguments.days));
        !ok) {
      return ok;
    }
  }
  const std::vector<std::string> hosts = arguments.hosts.empty() ? UsualHosts() : arguments.hosts;
  return tls::MakeCertificate(arguments.folder,
                              {arguments.name, hosts, ValidityOf(arguments.days)});
}

}  // namespace

void AddCertificatesCommand(const CommandLine& line) {
  CLI::App* group = line.app.add_subcommand(
      "certificates", "Make certificates for TLS, by an authority of one's own");
  group->require_subcommand(1);
  CLI::App* command = group->add_subcommand(
      "make", "Make one, and the authority that signs it if the folder holds none");
  auto arguments = std::make_shared<CertificatesArguments>();
  command->add_option("folder", arguments->folder, "where the authority and what it signs lie")
      ->required();
  command->add_option("--name", arguments->name, "whose it is; the files are called so")
      ->capture_default_str();
  command->add_option("--host", arguments->hosts,
                      "a name or address under which the server is called; without it: this "
                      "machine's name, localhost, 127.0.0.1 and ::1");
  command
      ->add_option("--days", arguments->days,
                   "for how long it is good; the authority ten times "
                   "as long")
      ->check(CLI::Range(1, 3650))
      ->capture_default_str();
  command->callback([arguments, line] {
    if (const auto made = MakeCertificates(*arguments); !made) {
      line.exit_code = Complain(made.error());
      return;
    }
    const std::filesystem::path folder = arguments->folder;
    std::printf(
        "certificate: %s\nkey:         %s (keep it to yourself)\n"
        "authority:   %s (give it to those who connect)\n",
        (folder / (arguments->name + ".pem")).c_str(),
        (folder / (arguments->name + "-key.pem")).c_str(), (folder / "ca.pem").c_str());
  });
}

}  // namespace gsv::app
