// Those who may call each other by CORBA: an authority, and a certificate of it for all programs
// that this test starts as long as the group lasts.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/programs.h"

namespace gsv::testing {

// A variable of the environment for as long as this lives; what it was before comes back.
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

class Group {
 public:
  Group();

  // "NAME.pem" of the folder in which `gsv certificates make` has put all of it.
  std::filesystem::path File(const std::string& name) const {
    return folder_.path() / "tls" / name;
  }

 private:
  const base::testing::TestFolder folder_{};
  const Variable certificate_;
};

}  // namespace gsv::testing
