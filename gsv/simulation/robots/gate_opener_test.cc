#include "gsv/simulation/robots/gate_opener.h"

#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

constexpr std::chrono::seconds kLong(60);

TEST(WaitGate, LetsPassOnlyThoseWhoCameBeforeItWasOpened) {
  WaitGate gate;
  const std::uint64_t before = gate.openings();
  gate.Open();
  EXPECT_TRUE(gate.WaitBeyond(before, WallNow() + kLong));
  EXPECT_FALSE(gate.WaitBeyond(gate.openings(), WallNow()));
}

// Few are opened by the caller, many by the opener's thread, and what is left by its destructor.
class GateOpenerOf : public testing::TestWithParam<int> {};

TEST_P(GateOpenerOf, OpensEachGateOnce) {
  GateOpener::Gates all;
  for (int i = 0; i < GetParam(); ++i) all.push_back(std::make_shared<WaitGate>());
  std::atomic<int> passed = 0;
  {
    std::vector<std::jthread> waiting;
    for (const auto& gate : all) {
      waiting.emplace_back([gate, &passed] { passed += gate->WaitBeyond(0, WallNow() + kLong); });
    }
    GateOpener opener;
    GateOpener::Gates gates = all;
    opener.Open(gates);
    EXPECT_TRUE(gates.empty());
  }
  EXPECT_EQ(passed, GetParam());
  for (const auto& gate : all) EXPECT_EQ(gate->openings(), 1u);
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, GateOpenerOf, testing::Values(1, 8, 9, 100));

}  // namespace
}  // namespace gsv::simulation
