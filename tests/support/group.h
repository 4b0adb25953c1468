// For tests: programs that may call each other by CORBA over TLS. The group has an authority, and a
// certificate for all programs that the test starts during its lifetime.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/programs.h"

namespace gsv::testing {

// Sets an environment variable during its lifetime, and restores the previous value.
class Variable {
 public:
  Variable(const char* name, const std::string& value);
  ~Variable();
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const std::string name_;
  std::string before_;
  bool was_set_ = false;
};

// The certificates of a group, in a temporary folder.
class Group {
 public:
  Group();

  // The file "NAME.pem" in the folder of `gsv certificates make`.
  std::filesystem::path File(const std::string& name) const {
    return folder_.path() / "tls" / name;
  }

 private:
  const base::testing::TestFolder folder_{};
  const Variable certificate_;
};

}  // namespace gsv::testing
