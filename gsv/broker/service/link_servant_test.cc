#include <algorithm>
#include <functional>

#include "gsv/broker/testing/broker_node.h"

namespace gsv::broker {
namespace {

using CosTrading::always;
using CosTrading::if_no_local;
using CosTrading::Link;
using CosTrading::local_only;

class LinkServantTest : public testing::Test {
 protected:
  std::vector<std::string> Names() {
    CosTrading::LinkNameSeq_var names = node_.link_->list_links();
    std::vector<std::string> result;
    for (CORBA::ULong i = 0; i < names->length(); ++i) result.emplace_back(names[i]);
    return result;
  }
  void Add(const char* name, CosTrading::FollowOption pass_on = always,
           CosTrading::FollowOption limiting = always) {
    node_.link_->add_link(name, other_.lookup_, pass_on, limiting);
  }

  BrokerNode node_;
  BrokerNode other_;
};

TEST_F(LinkServantTest, DescribesListsAndRemovesAddedLinks) {
  EXPECT_TRUE(Names().empty());
  Add("south");
  Add("north", local_only, if_no_local);
  EXPECT_EQ(Names(), (std::vector<std::string>{"north", "south"}));
  const Link::LinkInfo_var info = node_.link_->describe_link("north");
  EXPECT_TRUE(info->target->_is_equivalent(other_.lookup_));
  EXPECT_TRUE(info->target_reg->_is_equivalent(other_.register_));
  EXPECT_EQ(info->def_pass_on_follow_rule, local_only);
  EXPECT_EQ(info->limiting_follow_rule, if_no_local);
  node_.link_->modify_link("north", if_no_local, always);
  const Link::LinkInfo_var modified = node_.link_->describe_link("north");
  EXPECT_EQ(modified->def_pass_on_follow_rule, if_no_local);
  EXPECT_EQ(modified->limiting_follow_rule, always);
  node_.link_->remove_link("north");
  EXPECT_EQ(Names(), std::vector<std::string>{"south"});
}

TEST_F(LinkServantTest, RaisesForInvalidNames) {
  Add("north");
  EXPECT_STREQ(Raised<Link::IllegalLinkName>([&] { Add("to the north"); }).name, "to the north");
  EXPECT_STREQ(Raised<Link::DuplicateLinkName>([&] { Add("north"); }).name, "north");
  const CosTrading::Link_ptr link = node_.link_;
  const std::function<void(const char*)> calls[] = {
      [&](const char* name) { link->remove_link(name); },
      [&](const char* name) { const Link::LinkInfo_var info = link->describe_link(name); },
      [&](const char* name) { link->modify_link(name, always, always); }};
  for (const auto& call : calls) {
    EXPECT_STREQ(Raised<Link::IllegalLinkName>([&] { call("1st"); }).name, "1st");
    EXPECT_STREQ(Raised<Link::UnknownLinkName>([&] { call("west"); }).name, "west");
  }
}

TEST_F(LinkServantTest, RaisesForAnInvalidTarget) {
  const auto nil = Raised<CosTrading::InvalidLookupRef>(
      [&] { node_.link_->add_link("north", CosTrading::Lookup::_nil(), always, always); });
  EXPECT_TRUE(CORBA::is_nil(nil.target));
}

TEST_F(LinkServantTest, RaisesForRulesThatAreTooPermissive) {
  const auto by_default =
      Raised<Link::DefaultFollowTooPermissive>([&] { Add("north", always, if_no_local); });
  EXPECT_EQ(by_default.def_pass_on_follow_rule, always);
  EXPECT_EQ(by_default.limiting_follow_rule, if_no_local);
  EXPECT_EQ(node_.admin_->set_max_link_follow_policy(if_no_local), always);
  EXPECT_EQ(node_.link_->max_link_follow_policy(), if_no_local);
  const auto limiting =
      Raised<Link::LimitingFollowTooPermissive>([&] { Add("north", local_only, always); });
  EXPECT_EQ(limiting.limiting_follow_rule, always);
  EXPECT_EQ(limiting.max_link_follow_policy, if_no_local);

  Add("north", local_only, if_no_local);
  const auto modified_default = Raised<Link::DefaultFollowTooPermissive>(
      [&] { node_.link_->modify_link("north", if_no_local, local_only); });
  EXPECT_EQ(modified_default.def_pass_on_follow_rule, if_no_local);
  EXPECT_EQ(modified_default.limiting_follow_rule, local_only);
  const auto modified_limiting = Raised<Link::LimitingFollowTooPermissive>(
      [&] { node_.link_->modify_link("north", local_only, always); });
  EXPECT_EQ(modified_limiting.limiting_follow_rule, always);
  EXPECT_EQ(modified_limiting.max_link_follow_policy, if_no_local);
}

TEST_F(LinkServantTest, ReturnsItsComponentsAndAttributes) {
  EXPECT_TRUE(node_.lookup_->_is_equivalent(CosTrading::Lookup_var(node_.link_->lookup_if())));
  EXPECT_TRUE(node_.link_->supports_modifiable_properties());
  CosTrading::Admin::OctetSeq stem;
  stem.length(2);
  stem[0] = 7;
  stem[1] = 0;
  const CosTrading::Admin::OctetSeq_var before = node_.admin_->set_request_id_stem(stem);
  EXPECT_GT(before->length(), 0u) << "each trader begins with one of its own";
  const CosTrading::Admin::OctetSeq_var others = other_.admin_->request_id_stem();
  EXPECT_FALSE(std::equal(before->get_buffer(), before->get_buffer() + before->length(),
                          others->get_buffer(), others->get_buffer() + others->length()));
  CosTrading::Admin::OctetSeq_var after = node_.admin_->request_id_stem();
  ASSERT_EQ(after->length(), 2u);
  EXPECT_EQ(after[0], 7);
}

TEST_F(LinkServantTest, AcceptsLinksUpToTheLimit) {
  for (int i = 0; i < 100; ++i) Add(("link" + std::to_string(i)).c_str());
  Raised<CORBA::IMP_LIMIT>([&] { Add("one_more"); });
  EXPECT_EQ(Names().size(), 100u);
}

}  // namespace
}  // namespace gsv::broker
