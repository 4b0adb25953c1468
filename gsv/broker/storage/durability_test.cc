// Tests that offers survive the end of a broker process.
#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <set>
#include <thread>

#include "gsv/base/temporary_folder.h"
#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

class Folder {
 public:
  std::vector<std::string> Arguments() const {
    return {"0", "data=" + (folder_.path() / "broker.db").string()};
  }

 private:
  const base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-test").value();
};

class Broker : public BrokerFixture {
 public:
  explicit Broker(const Folder& folder) : BrokerFixture(folder.Arguments()) {}
  void TestBody() override {}
  using BrokerFixture::AddType;
  using BrokerFixture::admin_;
  using BrokerFixture::broker_;
  using BrokerFixture::Define;
  using BrokerFixture::Export;
  using BrokerFixture::Query;
  using BrokerFixture::register_;
  using BrokerFixture::Repository;
  using BrokerFixture::types_;

  std::set<std::string> OfferIds() {
    CosTrading::OfferIdSeq_var ids;
    CosTrading::OfferIdIterator_var rest;
    admin_->list_offers(1000, ids, rest);
    std::set<std::string> all;
    bool more = !CORBA::is_nil(rest);
    while (true) {
      for (CORBA::ULong i = 0; i < ids->length(); ++i) all.emplace(ids[i]);
      if (!more) return all;
      more = rest->next_n(1000, ids);
    }
  }
};

// Four clients export offers while the broker is killed.
TEST(Durability, AcknowledgedOffersSurviveAKill) {
  constexpr std::size_t kEnough = 400;
  const Folder folder;
  std::mutex mutex;
  std::set<std::string> answered;
  {
    Broker broker(folder);
    broker.AddType("Robot");
    std::atomic<std::size_t> count = 0;
    const auto export_until_it_ends = [&] {
      try {
        while (true) {
          const std::string id = broker.Export("Robot", {{"n", Value::Long(7)}});
          const std::lock_guard lock(mutex);
          answered.insert(id);
          ++count;
          count.notify_all();
        }
      } catch (const CORBA::SystemException&) {
        count += kEnough;
        count.notify_all();
      }
    };
    std::array<std::thread, 4> clients;
    for (std::thread& client : clients) client = std::thread(export_until_it_ends);
    for (std::size_t now = count; now < kEnough; now = count) count.wait(now);
    broker.broker_.Send(SIGKILL);
    for (std::thread& client : clients) client.join();
    EXPECT_EQ(broker.broker_.Wait(), -SIGKILL);
  }
  ASSERT_GE(answered.size(), kEnough);

  Broker again(folder);
  const std::set<std::string> kept = again.OfferIds();
  for (const std::string& id : answered) EXPECT_TRUE(kept.contains(id)) << id;
  EXPECT_LE(kept.size(), answered.size() + 4) << "at most one underway for each client";
  const CosTrading::Register::OfferInfo_var info =
      again.register_->describe(answered.begin()->c_str());
  EXPECT_TRUE(info->reference->_is_equivalent(TestService()));
  CORBA::Long n = 0;
  ASSERT_EQ(info->properties.length(), 1u);
  EXPECT_TRUE(info->properties[0].value >>= n);
  EXPECT_EQ(n, 7);
  EXPECT_FALSE(kept.contains(again.Export("Robot"))) << "a new offer has a new id";
}

TEST(Durability, TypesSurviveAKillWithSuperTypesMasksAndIncarnations) {
  const Folder folder;
  {
    Broker broker(folder);
    broker.AddType("Vehicle", {Broker::Define("speed", CORBA::_tc_double,
                                              Broker::Repository::PROP_MANDATORY)});
    broker.AddType("Car", {}, {"Vehicle"});
    broker.types_->mask_type("Car");
    broker.AddType("Gone");
    broker.types_->remove_type("Gone");
    broker.broker_.Send(SIGKILL);
    broker.broker_.Wait();
  }
  Broker again(folder);
  const Broker::Repository::TypeStruct_var car = again.types_->fully_describe_type("Car");
  EXPECT_TRUE(car->masked);
  EXPECT_EQ(car->incarnation.low, 2u);
  ASSERT_EQ(car->super_types.length(), 1u);
  EXPECT_STREQ(car->super_types[0], "Vehicle");
  ASSERT_EQ(car->props.length(), 1u);
  EXPECT_STREQ(car->props[0].name, "speed");
  EXPECT_TRUE(car->props[0].value_type->equal(CORBA::_tc_double));
  EXPECT_EQ(car->props[0].mode, Broker::Repository::PROP_MANDATORY);
  EXPECT_EQ(again.types_->incarnation().low, 4u);
  Raised<CosTrading::UnknownServiceType>([&] { again.types_->describe_type("Gone"); });
}

TEST(Durability, EverythingSurvivesACleanShutdown) {
  const Folder folder;
  std::string kept;
  {
    Broker broker(folder);
    broker.AddType("Robot");
    kept = broker.Export("Robot");
    const std::string withdrawn = broker.Export("Robot");
    broker.register_->withdraw(withdrawn.c_str());
    broker.broker_.Send(SIGTERM);
    EXPECT_EQ(broker.broker_.Wait(), 0);
  }
  Broker again(folder);
  EXPECT_EQ(again.OfferIds(), std::set<std::string>{kept});
  EXPECT_EQ(again.Query("Robot").offers->length(), 1u);
}

TEST(Durability, BrokerDoesNotStartIfItsFileCannotBeOpened) {
  const Folder folder;
  const Broker first(folder);
  BrokerProcess second(folder.Arguments());
  EXPECT_EQ(second.reference(), "");
  EXPECT_EQ(second.Wait(), 5);
  EXPECT_EQ(
      second.Stderr(),
      folder.Arguments()[1].substr(5) +
          ": another broker is using this file; stop it, or choose another file with --data\n");
}

}  // namespace
}  // namespace gsv::broker
