// The ORB of a process, for offers and calls. The ORB starts with its first user and ends with its
// last user.
//
// Threads  any. The destructor of the last user waits for incoming calls in progress.
#pragma once

#include <memory>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"

namespace gsv::sdk {

class SharedOrb {
 public:
  // Returns the existing ORB. If there is none, starts one that listens on the local address that
  // reaches `broker`. GSV_FAULT_DELAY delays its calls (fault_delay.h).
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
