// For tests: one of several linked brokers, in its own process.
#pragma once

#include <string>
#include <vector>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {

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

  void LinkTo(const BrokerNode& other, const char* name,
              CosTrading::FollowOption pass_on = CosTrading::always,
              CosTrading::FollowOption limiting = CosTrading::always) {
    link_->add_link(name, other.lookup_, pass_on, limiting);
  }

  CosTrading::Link_var link_;
};

}  // namespace gsv::broker
