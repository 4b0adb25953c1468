#include "gsv/verdict/monitor.h"

#include <random>

#include <gtest/gtest.h>

namespace gsv::verdict {
namespace {

using base::SimTime;
using scenario::Formula;
using MonitorKind = Formula::Kind;
using Trace = std::vector<std::vector<bool>>;  // truth values by step, then by atom

constexpr SimTime kStep{100'000'000};  // 0.1 s

Formula AtomNumber(int number) {
  Formula atom;
  atom.quantity.value = number;
  return atom;
}

Formula Of(MonitorKind kind, std::vector<Formula> parts, double from = 0,
           std::optional<double> by = std::nullopt) {
  Formula formula;
  formula.kind = kind;
  formula.parts = std::move(parts);
  formula.from = from;
  formula.by = by;
  return formula;
}

// Evaluates a formula by the definition of its operators (docs/testing.md).
bool Means(const Formula& f, const Trace& trace, std::size_t at) {
  const auto in_window = [&](std::size_t i) {
    const SimTime since = static_cast<std::int64_t>(i - at) * kStep;
    return since >= base::FromSeconds(f.from) && (!f.by || since <= base::FromSeconds(*f.by));
  };
  switch (f.kind) {
    case MonitorKind::kAtom:
      return trace[at][static_cast<std::size_t>(f.quantity.value)];
    case MonitorKind::kNot:
      return !Means(f.parts[0], trace, at);
    case MonitorKind::kAll:
      for (const Formula& part : f.parts)
        if (!Means(part, trace, at)) return false;
      return true;
    case MonitorKind::kAny:
      for (const Formula& part : f.parts)
        if (Means(part, trace, at)) return true;
      return false;
    case MonitorKind::kAlways:
      for (std::size_t i = at; i < trace.size(); ++i)
        if (in_window(i) && !Means(f.parts[0], trace, i)) return false;
      return true;
    case MonitorKind::kEventually:
      for (std::size_t i = at; i < trace.size(); ++i)
        if (in_window(i) && Means(f.parts[0], trace, i)) return true;
      return false;
    case MonitorKind::kUntil:
      for (std::size_t i = at; i < trace.size(); ++i) {
        if (in_window(i) && Means(f.parts[1], trace, i)) return true;
        if (!Means(f.parts[0], trace, i)) return false;
      }
      return false;
  }
  return false;
}

struct MonitorVerdict {
  bool holds = false;
  std::size_t at = 0;  // the step at which the verdict became certain
};

MonitorVerdict RunMonitor(const Formula& formula, const Trace& trace) {
  Monitor monitor(formula, [](const Formula& atom) { return atom.quantity.value; });
  for (std::size_t i = 0; i < trace.size(); ++i) {
    monitor.Step(static_cast<std::int64_t>(i) * kStep, kStep,
                 [&](int atom) { return trace[i][static_cast<std::size_t>(atom)]; });
    if (monitor.verdict()) return {*monitor.verdict(), i};
  }
  monitor.End();
  return {*monitor.verdict(), trace.size() - 1};
}

// Makes a trace from the truth values of the atoms by step, such as "0011".
Trace TraceOf(const std::string& a, const std::string& b = "") {
  Trace trace;
  for (std::size_t i = 0; i < a.size(); ++i) {
    trace.push_back({a[i] == '1', i < b.size() && b[i] == '1'});
  }
  return trace;
}

void Expect(const Formula& formula, const Trace& trace, bool holds, std::size_t at) {
  const MonitorVerdict judged = RunMonitor(formula, trace);
  EXPECT_EQ(judged.holds, holds);
  EXPECT_EQ(judged.at, at);
}

TEST(Monitor, AlwaysIsViolatedAtTheFirstFalseState) {
  const Formula always = Of(MonitorKind::kAlways, {AtomNumber(0)});
  Expect(always, TraceOf("111011"), false, 3);
  Expect(always, TraceOf("0"), false, 0);
  Expect(always, TraceOf("1111"), true, 3);
  Expect(Of(MonitorKind::kAlways, {AtomNumber(0)}, 0.2, 0.3), TraceOf("0011001"), true, 3);
}

TEST(Monitor, EventuallyIsViolatedAtTheLastStateOfItsWindow) {
  const Formula eventually = Of(MonitorKind::kEventually, {AtomNumber(0)}, 0, 0.3);
  Expect(eventually, TraceOf("000011"), false, 3);
  Expect(eventually, TraceOf("000111"), true, 3);
  Expect(Of(MonitorKind::kEventually, {AtomNumber(0)}), TraceOf("0000"), false, 3);
  // No state is in the window from 0.21 to 0.29 s.
  Expect(Of(MonitorKind::kEventually, {AtomNumber(0)}, 0.21, 0.29), TraceOf("111111"), false, 2);
}

TEST(Monitor, UntilIsViolatedIfItsSecondConditionNeverHolds) {
  const Formula until = Of(MonitorKind::kUntil, {AtomNumber(0), AtomNumber(1)});
  Expect(until, TraceOf("1110", "0001"), true, 3);
  Expect(until, TraceOf("1100", "0001"), false, 2);
  Expect(until, TraceOf("1111", "0000"), false, 3);
}

TEST(Monitor, ResponseIsRequiredWithinItsWindow) {
  const Formula answered =
      Of(MonitorKind::kAlways,
         {Of(MonitorKind::kAny, {Of(MonitorKind::kNot, {AtomNumber(0)}),
                                 Of(MonitorKind::kEventually, {AtomNumber(1)}, 0, 0.2)})});
  Expect(answered, TraceOf("010000010", "000100000"), false, 8);
  Expect(answered, TraceOf("0100000", "0000100"), false, 3);
  Expect(answered, TraceOf("0101000", "0001010"), true, 6);
}

Formula RandomFormula(std::mt19937& random, int depth) {
  const auto number = [&](int below) {
    return static_cast<int>(random() % static_cast<unsigned>(below));
  };
  const int kind = depth == 0 ? 0 : number(7);
  const double from = number(3) == 0 ? 0.1 * number(4) : 0;
  const std::optional<double> by =
      number(2) == 0 ? std::optional(from + 0.1 * number(5)) : std::nullopt;
  const auto part = [&] { return RandomFormula(random, depth - 1); };
  switch (kind) {
    case 0:
      return AtomNumber(number(3));
    case 1:
      return Of(MonitorKind::kNot, {part()});
    case 2:
      return Of(MonitorKind::kAll, {part(), part()});
    case 3:
      return Of(MonitorKind::kAny, {part(), part(), part()});
    case 4:
      return Of(MonitorKind::kAlways, {part()}, from, by);
    case 5:
      return Of(MonitorKind::kEventually, {part()}, from, by);
    default:
      return Of(MonitorKind::kUntil, {part(), part()}, from, by);
  }
}

TEST(Monitor, AgreesWithTheDefinitionOfTheOperators) {
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    const Formula formula = RandomFormula(random, 3);
    Trace trace(1 + random() % 12);
    for (auto& state : trace) {
      for (int atom = 0; atom < 3; ++atom) state.push_back(random() % 2 == 0);
    }
    const MonitorVerdict judged = RunMonitor(formula, trace);
    ASSERT_EQ(judged.holds, Means(formula, trace, 0)) << "formula " << i;
    // The verdict was certain at the step `judged.at`. So every part of the trace from its start to
    // this step or a later step must have the same verdict.
    for (std::size_t length = judged.at + 1; length < trace.size(); ++length) {
      const Trace shorter(trace.begin(), trace.begin() + static_cast<std::ptrdiff_t>(length));
      ASSERT_EQ(Means(formula, shorter, 0), judged.holds) << "formula " << i;
    }
  }
}

TEST(Monitor, ObligationsDoNotGrowWithTheRun) {
  const Formula answered =
      Of(MonitorKind::kAlways, {Of(MonitorKind::kEventually, {AtomNumber(0)}, 0, 1000)});
  Monitor monitor(answered, [](const Formula&) { return 0; });
  for (int i = 0; i < 9'000; ++i) {  // quadratic growth would take minutes
    monitor.Step(i * kStep, kStep, [](int) { return false; });
  }
  EXPECT_EQ(monitor.verdict(), std::nullopt);
}

}  // namespace
}  // namespace gsv::verdict
