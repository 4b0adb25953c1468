// gsv certificates: a small certificate authority, and certificates signed by it.
#include <cstdio>

#include <CLI/CLI.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/base/host_name.h"
#include "gsv/tls/certificates.h"

namespace gsv::app {
namespace {

struct CertificatesArguments {
  std::string folder;
  std::vector<std::string> names{"server"}, hosts;
  int days = 365;
};

tls::Validity ValidityOf(int days) {
  tls::Validity validity;
  validity.ends = std::chrono::hours(24 * days);
  return validity;
}

// Returns the default of --host: the names and addresses of this machine.
std::vector<std::string> UsualHosts() {
  std::vector<std::string> hosts{"localhost", "127.0.0.1", "::1"};
  if (const std::string name = base::HostName(); name != hosts.front()) hosts.push_back(name);
  return hosts;
}

base::Status MakeCertificates(const CertificatesArguments& arguments) {
  if (!tls::HasAuthority(arguments.folder)) {
    // The authority's certificate is valid this many times as long as the certificates that it
    // signs.
    constexpr int kTimesAsLong = 10;
    if (auto ok = tls::MakeAuthority(arguments.folder, ValidityOf(kTimesAsLong * arguments.days));
        !ok) {
      return ok;
    }
  }
  const std::vector<std::string> hosts = arguments.hosts.empty() ? UsualHosts() : arguments.hosts;
  for (const std::string& name : arguments.names) {
    if (auto ok = tls::MakeCertificate(arguments.folder, {name, hosts, ValidityOf(arguments.days)});
        !ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace

void AddCertificatesCommand(const CommandLine& line) {
  CLI::App* group = line.app.add_subcommand(
      "certificates", "Make certificates for TLS, signed by your own authority");
  group->require_subcommand(1);
  CLI::App* command = group->add_subcommand(
      "make", "Make certificates, and the authority that signs them if the folder has none");
  auto arguments = std::make_shared<CertificatesArguments>();
  command->add_option("folder", arguments->folder, "folder of the authority and its certificates")
      ->required();
  command
      ->add_option("--name", arguments->names, "name of a certificate and of its files; repeatable")
      ->allow_extra_args(false)
      ->type_name("NAME")
      ->capture_default_str();
  command
      ->add_option("--host", arguments->hosts,
                   "name or address of the server (default: those of this machine)\n"
                   "The default is the host name, localhost, 127.0.0.1 and ::1.")
      ->type_name("NAME");
  command
      ->add_option("--days", arguments->days,
                   "validity of a certificate in days; the authority is valid ten times as long")
      ->check(Between(1, 3650))
      ->type_name("N")
      ->capture_default_str();
  command->callback([arguments, line] {
    if (const auto made = MakeCertificates(*arguments); !made) {
      line.exit_code = PrintError(made.error());
      return;
    }
    const std::filesystem::path folder = arguments->folder;
    for (const std::string& name : arguments->names) {
      std::printf("certificate: %s\nkey:         %s (keep it secret)\n",
                  (folder / (name + ".pem")).c_str(), (folder / (name + "-key.pem")).c_str());
    }
    std::printf("authority:   %s (give it to everyone who connects)\n",
                (folder / "ca.pem").c_str());
  });
}

}  // namespace gsv::app
