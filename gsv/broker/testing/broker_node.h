// For tests: one of several linked brokers, in its own process.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {

// Returns the number as a value for BrokerFixture::Policy().
inline CORBA::Any ULong(CORBA::ULong value) {
  CORBA::Any any;
  any <<= value;
  return any;
}

class BrokerNode : public BrokerFixture {
 public:
  explicit BrokerNode(std::vector<std::string> arguments = {"0"})
      : BrokerFixture(std::move(arguments)), link_(lookup_->link_if()) {}
  void TestBody() override {}

  using BrokerFixture::AddType;
  using BrokerFixture::admin_;
  using BrokerFixture::Answer;
  using BrokerFixture::broker_;
  using BrokerFixture::Define;
  using BrokerFixture::Export;
  using BrokerFixture::lookup_;
  using BrokerFixture::Policy;
  using BrokerFixture::Query;
  using BrokerFixture::register_;
  using BrokerFixture::Repository;
  using BrokerFixture::Sequence;
  using BrokerFixture::types_;

  // Adds a link from this broker to `other`, with the link's two follow rules.
  void LinkTo(const BrokerNode& other, const char* name,
              CosTrading::FollowOption pass_on = CosTrading::always,
              CosTrading::FollowOption limiting = CosTrading::always) {
    link_->add_link(name, other.lookup_, pass_on, limiting);
  }

  CosTrading::Link_var link_;  // the broker's interface for links
};

}  // namespace gsv::broker
