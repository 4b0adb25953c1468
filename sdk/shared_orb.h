// The ORB that all of a process share: what it offers, what it asks others. It starts with the
// first who needs it and ends with the last.
//
// Threads  any. Letting go of the last one waits for the calls that others have under way here.
#pragma once

#include <memory>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"

namespace gsv::sdk {

class SharedOrb {
 public:
  // The one that there is; else a new one, which listens on the local address that reaches
  // `broker`, and whose calls are delayed when the environment says so (fault_delay.h).
  static base::Result<std::shared_ptr<SharedOrb>> Towards(const std::string& broker);
  ~SharedOrb();
  SharedOrb(const SharedOrb&) = delete;
  SharedOrb& operator=(const SharedOrb&) = delete;

  CORBA::ORB_ptr orb() const { return orb_; }

 private:
  explicit SharedOrb(const CORBA::ORB_var& orb) : orb_(orb) {}

  CORBA::ORB_var orb_;
};

}  // namespace gsv::sdk
