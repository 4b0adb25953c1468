// What the viewer's page "Join" asks, over HTTP:
//   GET /api/instances   every gsv that the broker knows, and its simulations
//
// Threads  any. One question is put to the others at a time; whoever asks meanwhile gets the last
//          answer.
#pragma once

#include <string>
#include <utility>

#include <omniORB4/CORBA.h>

#include "gsv/base/mutex.h"
#include "gsv/gateway/http/http.h"

namespace gsv::app {

class InstancesPage {
 public:
  // `place` is this program's own "host:pid".
  InstancesPage(CORBA::ORB_ptr orb, std::string broker, std::string place)
      : orb_(CORBA::ORB::_duplicate(orb)), broker_(std::move(broker)), place_(std::move(place)) {}

  gateway::Response Handle(const gateway::Request& request);

 private:
  gateway::Response Ask() const;

  const CORBA::ORB_var orb_;
  const std::string broker_, place_;
  base::Mutex asking_;
  base::Mutex mutex_;
  gateway::Response last_ GSV_GUARDED_BY(mutex_);
  bool has_asked_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::app
