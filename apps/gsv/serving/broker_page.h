// What the viewer's broker page asks, over HTTP:
//   GET /api/broker/types   the service types
//   GET /api/broker/offers?type=&constraint=&preference=
//                           offers of a type: which match and, of the others, which term failed
//   GET /api/broker/links   the links, and whether they answer
//
// Threads  any.
#pragma once

#include <string>
#include <utility>

#include <omniORB4/CORBA.h>

#include "gsv/gateway/http/http.h"

namespace gsv::app {

class BrokerPage {
 public:
  BrokerPage(CORBA::ORB_ptr orb, std::string broker)
      : orb_(CORBA::ORB::_duplicate(orb)), broker_(std::move(broker)) {}

  // `request.target` begins with "api/broker".
  gateway::Response Handle(const gateway::Request& request) const;

 private:
  gateway::Response Types() const;
  gateway::Response Offers(const gateway::Target& target) const;
  gateway::Response Links() const;

  const CORBA::ORB_var orb_;
  const std::string broker_;
};

}  // namespace gsv::app
