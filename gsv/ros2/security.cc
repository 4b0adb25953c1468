#include "gsv/ros2/security.h"

#include <filesystem>
#include <initializer_list>
#include <string>

#include "gsv/ros2/names.h"

namespace gsv::ros2 {
namespace {

constexpr const char* kEnable = "ROS_SECURITY_ENABLE";
constexpr const char* kKeystore = "ROS_SECURITY_KEYSTORE";
constexpr const char* kStrategy = "ROS_SECURITY_STRATEGY";
constexpr const char* kEnclave = "ROS_SECURITY_ENCLAVE_OVERRIDE";

// Returns true if the variable has the value `first`. Returns false if it has the value `second` or
// is empty. Fails for other values.
base::Result<bool> IsFirst(const Environment& environment, const char* variable, const char* first,
                           const char* second) {
  const std::string value = environment(variable);
  if (value == first) return true;
  if (value.empty() || value == second) return false;
  return base::Fail(
      base::ErrorCode::kInvalidArgument,
      std::string("must be ") + first + " or " + second + ", found '" + value.substr(0, 100) + "'",
      variable);
}

// Returns the folder of an enclave. Fails if one of its files does not exist.
base::Result<std::string> FolderOf(const std::string& keystore, const std::string& enclave) {
  if (keystore.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "is not set, but ROS_SECURITY_ENABLE is true. Make a keystore with "
                      "`ros2 security create_keystore`",
                      kKeystore);
  }
  const std::filesystem::path enclaves = std::filesystem::path(keystore) / "enclaves";
  const std::filesystem::path folder = enclave == "/" ? enclaves : enclaves / enclave.substr(1);
  for (const char* file : kEnclaveFiles) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder / file, ignored)) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "there is no " + std::string(file) + " in " + folder.string() +
                          ". Set ROS_SECURITY_ENCLAVE_OVERRIDE, or make the enclave with "
                          "`ros2 security create_enclave`",
                      kKeystore);
  }
  return folder.string();
}

}  // namespace

base::Status UseSecurity(const Environment& environment, dds::ParticipantOptions& participant) {
  participant.user_data = "enclave=/;";
  const auto is_on = IsFirst(environment, kEnable, "true", "false");
  if (!is_on) return base::Fail(is_on.error());
  if (!*is_on) return {};
  const auto is_enforced = IsFirst(environment, kStrategy, "Enforce", "Permissive");
  if (!is_enforced) return base::Fail(is_enforced.error());
  std::string enclave = environment(kEnclave);
  if (enclave.empty()) enclave = "/";
  if (!IsNamespace(enclave)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "must be an enclave such as /gsv, found '" + enclave.substr(0, 100) + "'",
                      kEnclave);
  }
  const auto folder = FolderOf(environment(kKeystore), enclave);
  if (!folder && *is_enforced) return base::Fail(folder.error());
  if (!folder) {
    participant.insecure_reason = folder.error().Sentence();
    return {};
  }
  participant.enclave_folder = *folder;
  participant.user_data = "enclave=" + enclave + ";";
  return {};
}

}  // namespace gsv::ros2
