#include "tests/support/group.h"

#include <cstdlib>
#include <stdexcept>

namespace gsv::testing {

Variable::Variable(const char* name, const std::string& value) : name_(name) {
  if (const char* before = std::getenv(name)) {
    before_ = before;
    was_set_ = true;
  }
  setenv(name, value.c_str(), 1);
}

Variable::~Variable() {
  was_set_ ? setenv(name_.c_str(), before_.c_str(), 1) : unsetenv(name_.c_str());
}

Group::Group() : certificate_("GSV_CORBA_CERTIFICATE", File("lab.pem")) {
  const Outcome made = RunProgram("gsv", {"certificates", "make", File(""), "--name", "lab"});
  if (made.ending != "exit code 0") throw std::runtime_error(made.err);
}

}  // namespace gsv::testing
