#include "gsv/verdict/judge.h"

#include <algorithm>
#include <cmath>

namespace gsv::verdict {
namespace {

constexpr std::size_t kMaxReportedAtoms = 4;

std::string InWords(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

bool Lies(const scenario::Formula& atom, std::optional<double> value) {
  return value && *value >= atom.min && *value <= atom.max;
}

std::string Bounds(const scenario::Formula& atom) {
  constexpr double kNone = 1e8;
  std::string text;
  if (atom.min > -kNone && atom.min != 0) text += "at least " + InWords(atom.min);
  if (atom.max < kNone) text += (text.empty() ? "" : ", ") + ("at most " + InWords(atom.max));
  return text;
}

std::string MeasuredText(const MeasuredAtom& measured) {
  const scenario::Quantity& quantity = measured.atom.quantity;
  if (quantity.kind == scenario::Quantity::Kind::kStuck) {
    const std::string who = quantity.first.empty() ? measured.about : quantity.first;
    if (!Lies(measured.atom, measured.last)) return "no robot was stuck";
    return who + " was stuck: it was commanded to move for " + InWords(measured.last) +
           " s and did not";
  }
  const std::string what = Describe(quantity);
  using QuantityKind = scenario::Quantity::Kind;
  if (quantity.kind == QuantityKind::kContact || quantity.kind == QuantityKind::kEnded) {
    return what + (measured.last > 0 ? ": yes" : ": no");
  }
  if (!measured.was_measured) return what + " could not be measured";
  const std::string unit = UnitOf(quantity);
  return what + " was " + InWords(measured.last) + unit + " (" + Bounds(measured.atom) +
         "; it ranged from " + InWords(measured.lowest) + " at " + InWords(measured.lowest_at) +
         " s to " + InWords(measured.highest) + " at " + InWords(measured.highest_at) + " s)";
}

// NaN is ignored, because it is not a measurement.
void Note(std::optional<double> value, double now, MeasuredAtom& measured) {
  if (!value || std::isnan(*value)) return;
  if (!measured.was_measured || *value < measured.lowest) {
    measured.lowest = *value;
    measured.lowest_at = now;
  }
  if (!measured.was_measured || *value > measured.highest) {
    measured.highest = *value;
    measured.highest_at = now;
  }
  measured.was_measured = true;
  measured.last = *value;
}

// Returns the formula. If it does not set the time after which a robot is stuck, inserts the time
// of the scenario.
scenario::Formula WithStuckAfter(scenario::Formula formula, base::SimTime stuck_after) {
  if (formula.quantity.kind == scenario::Quantity::Kind::kStuck && formula.min < 0) {
    formula.min = base::ToSeconds(stuck_after);
  }
  for (scenario::Formula& part : formula.parts) {
    part = WithStuckAfter(std::move(part), stuck_after);
  }
  return formula;
}

void AddBodies(const MeasuredAtom& measured, std::vector<std::string>& bodies) {
  const scenario::Quantity& quantity = measured.atom.quantity;
  const bool is_sensor = quantity.kind == scenario::Quantity::Kind::kSensor;
  for (const std::string& name :
       {measured.about, quantity.first, is_sensor ? std::string() : quantity.second}) {
    const bool is_known = std::find(bodies.begin(), bodies.end(), name) != bodies.end();
    if (!name.empty() && !is_known) bodies.push_back(name);
  }
}

base::Status CheckAtoms(const std::vector<MeasuredAtom>& atoms, const Measure& measure,
                        const std::string& where) {
  for (const MeasuredAtom& measured : atoms) {
    if (const auto ok = measure.Check(measured.atom.quantity); !ok)
      return base::Fail(ok.error().code, ok.error().Sentence(), where);
  }
  return {};
}

}  // namespace

std::string Finding::Sentence() const {
  if (holds) return "holds";
  std::string text =
      "violated at " + InWords(base::ToSeconds(time)) + " s (step " + std::to_string(step) + ")";
  for (std::size_t i = 0; i < std::min(atoms.size(), kMaxReportedAtoms); ++i) {
    text += (i == 0 ? ": " : "; ") + MeasuredText(atoms[i]);
  }
  return text;
}

base::Result<std::shared_ptr<Judge>> Judge::Attach(
    const std::vector<scenario::Expectation>& expectations, simulation::Simulation& simulation) {
  std::shared_ptr<Judge> judge(new Judge(simulation));
  for (const scenario::Expectation& expectation : expectations) {
    Finding finding{expectation.name, expectation.yaml, expectation.source.text};
    const scenario::Formula formula =
        WithStuckAfter(expectation.formula, simulation.specification().stuck_after);
    Monitor monitor(formula, [&](const scenario::Formula& atom) {
      finding.atoms.push_back({atom});
      return static_cast<int>(finding.atoms.size() - 1);
    });
    if (auto ok = CheckAtoms(finding.atoms, judge->measure_, finding.where); !ok)
      return base::Fail(ok.error());
    const base::MutexLock lock(judge->mutex_);
    judge->pending_.push_back({std::move(finding), std::move(monitor), formula, MarginOf(formula)});
  }
  simulation.SetExpectations(judge);
  judge->JudgeState(simulation.snapshot());
  simulation.AddObserver(judge);
  return judge;
}

void Judge::OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) {
  JudgeState(snapshot);
  judged_.notify_all();
}

void Judge::JudgeState(const std::shared_ptr<const world::Snapshot>& snapshot) {
  const base::MutexLock lock(mutex_);
  latest_ = snapshot;
  if (pending_.empty()) return;
  measure_.MoveTo(snapshot);
  const double now = base::ToSeconds(snapshot->state.time);
  for (Pending& pending : pending_) {
    if (pending.monitor.verdict()) continue;
    std::vector<bool> holds;
    std::vector<std::optional<double>> values;
    for (MeasuredAtom& measured : pending.finding.atoms) {
      const auto value = measure_.Of(measured.atom.quantity);
      Note(value, now, measured);
      values.push_back(value);
      if (measured.atom.quantity.kind == scenario::Quantity::Kind::kStuck) {
        measured.about = measure_.stuck_longest();
      }
      holds.push_back(Lies(measured.atom, value));
    }
    if (pending.margin) pending.margin->Note(snapshot->state.time, values);
    pending.monitor.Step(snapshot->state.time, simulation_.specification().step,
                         [&](int atom) { return holds[static_cast<std::size_t>(atom)]; });
    if (pending.monitor.verdict()) RecordVerdict(pending, snapshot);
  }
}

void Judge::RecordVerdict(Pending& pending, const std::shared_ptr<const world::Snapshot>& snapshot,
                          bool is_end) {
  pending.finding.holds = *pending.monitor.verdict();
  pending.finding.step = snapshot->state.step;
  pending.finding.time = snapshot->state.time;
  if (!pending.finding.holds && first_violation_ == nullptr) first_violation_ = snapshot;
  if (!is_end || !pending.finding.holds) EmitVerdict(pending.finding);
}

void Judge::EmitVerdict(const Finding& finding) {
  if (finding.holds) {
    simulation_.Emit("expectation_held", "", finding.name);
    return;
  }
  std::string robot;
  for (const MeasuredAtom& measured : finding.atoms) {
    if (!robot.empty()) break;
    robot = measured.about.empty() ? measured.atom.quantity.first : measured.about;
  }
  simulation_.Emit("expectation_violated", robot, finding.name + ": " + finding.Sentence());
}

std::vector<simulation::ExpectationState> Judge::states() const {
  using Verdict = simulation::ExpectationState::Verdict;
  const base::MutexLock lock(mutex_);
  std::vector<simulation::ExpectationState> states;
  for (const Pending& pending : pending_) {
    const Finding& finding = pending.finding;
    simulation::ExpectationState& state = states.emplace_back();
    state.name = finding.name;
    state.yaml = finding.yaml;
    state.where = finding.where;
    if (const auto verdict = pending.monitor.verdict()) {
      state.verdict = *verdict ? Verdict::kHolds : Verdict::kViolated;
      state.step = finding.step;
      state.time = finding.time;
      if (!*verdict) state.detail = finding.Sentence();
    }
    if (pending.margin) pending.margin->Fill(state);
    AddShapes(pending.formula, state);
    for (const MeasuredAtom& measured : finding.atoms) AddBodies(measured, state.bodies);
  }
  return states;
}

std::vector<Finding> Judge::Finish() {
  const std::int64_t last = simulation_.snapshot()->state.step;
  base::MutexLock lock(mutex_);
  judged_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return latest_->state.step >= last; });
  std::vector<Finding> findings;
  for (Pending& pending : pending_) {
    if (!pending.monitor.verdict()) {
      pending.monitor.End();
      RecordVerdict(pending, latest_, true);
    }
    findings.push_back(pending.finding);
  }
  return findings;
}

std::shared_ptr<const world::Snapshot> Judge::first_violation() const {
  const base::MutexLock lock(mutex_);
  return first_violation_;
}

}  // namespace gsv::verdict
