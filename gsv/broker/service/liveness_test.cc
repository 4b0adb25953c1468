// Tests offers of real services that die, hang and return.
#include <chrono>
#include <csignal>
#include <thread>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

constexpr std::chrono::seconds kTimeout{40};  // shorter than the test's own time limit

class LivenessTest : public BrokerFixture {
 protected:
  explicit LivenessTest(const std::string& max_silence_ms = "3600000")
      : BrokerFixture({"0", "liveness_ms=20", "max_silence_ms=" + max_silence_ms}) {}

  bool IsOffered(const std::string& id) {
    try {
      const Register::OfferInfo_var info = register_->describe(id.c_str());
      return true;
    } catch (const CosTrading::UnknownOfferId&) {
      return false;
    }
  }
  void AwaitWithdrawal(const std::string& id) {
    const auto give_up = std::chrono::steady_clock::now() + kTimeout;
    while (IsOffered(id)) {
      ASSERT_LT(std::chrono::steady_clock::now(), give_up) << id << " is still offered";
      std::this_thread::yield();
    }
  }
};

class ShortSilenceLivenessTest : public LivenessTest {
 protected:
  ShortSilenceLivenessTest() : LivenessTest("500") {}
};

TEST_F(LivenessTest, OnlyTheOfferOfAKilledProgramIsWithdrawn) {
  ServiceProcess living(broker_.reference());
  ServiceProcess killed(broker_.reference());
  ASSERT_TRUE(IsOffered(killed.offer_id()));
  killed.Send(SIGKILL);
  killed.Wait();
  ASSERT_NO_FATAL_FAILURE(AwaitWithdrawal(killed.offer_id()));
  EXPECT_TRUE(IsOffered(living.offer_id()));
  EXPECT_EQ(Query("Service").offers->length(), 1u);
}

TEST_F(LivenessTest, OfferOfADestroyedObjectIsWithdrawn) {
  ServiceProcess living(broker_.reference());
  const CORBA::Object_var root = TestOrb()->resolve_initial_references("RootPOA");
  const PortableServer::POA_var poa = PortableServer::POA::_narrow(root);
  const CORBA::Object_var object = poa->create_reference(kServiceInterface);
  const CORBA::String_var id = register_->_cxx_export(object, "Service", {});
  ASSERT_NO_FATAL_FAILURE(AwaitWithdrawal(id.in()));
  EXPECT_TRUE(IsOffered(living.offer_id()));
}

// A stopped service does not answer, but its offer must stay. The test waits three times until the
// monitor has withdrawn the offer of a killed service. In the meantime, the monitor calls the
// stopped service several times.
TEST_F(LivenessTest, OfferOfAStoppedProgramStaysUntilTheMaximumSilence) {
  ServiceProcess still(broker_.reference());
  still.Stop();
  for (int i = 0; i < 3; ++i) {
    ServiceProcess killed(broker_.reference());
    killed.Send(SIGKILL);
    killed.Wait();
    ASSERT_NO_FATAL_FAILURE(AwaitWithdrawal(killed.offer_id()));
  }
  EXPECT_TRUE(IsOffered(still.offer_id()));
  still.Send(SIGCONT);
}

TEST_F(ShortSilenceLivenessTest, OfferOfAProgramThatIsStoppedTooLongIsWithdrawn) {
  ServiceProcess still(broker_.reference());
  still.Stop();
  AwaitWithdrawal(still.offer_id());
}

}  // namespace
}  // namespace gsv::broker
