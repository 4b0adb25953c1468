#include "gsv/verdict/judge.h"

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

std::string Told(const MeasuredAtom& measured) {
  const scenario::Quantity& quantity = measured.atom.quantity;
  const std::string what = Describe(quantity);
  using QuantityKind = scenario::Quantity::Kind;
  if (quantity.kind == QuantityKind::kContact || quantity.kind == QuantityKind::kEnded) {
    return what + (measured.last > 0 ? ": yes" : ": no");
  }
  if (!measured.was_measured) return what + " could not be had";
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
    text += (i == 0 ? ": " : "; ") + Told(atoms[i]);
  }
  return text;
}

base::Result<std::shared_ptr<Judge>> Judge::Attach(
    const std::vector<scenario::Expectation>& expectations, simulation::Simulation& simulation) {
  std::shared_ptr<Judge> judge(new Judge(simulation));
  for (const scenario::Expectation& expectation : expectations) {
    Finding finding{expectation.name, expectation.yaml, expectation.source.text};
    Monitor monitor(expectation.formula, [&](const scenario::Formula& atom) {
      finding.atoms.push_back({atom});
      return static_cast<int>(finding.atoms.size() - 1);
    });
    if (auto ok = CheckAtoms(finding.atoms, judge->measure_, finding.where); !ok)
      return base::Fail(ok.error());
    const base::MutexLock lock(judge->mutex_);
    judge->pending_.push_back({std::move(finding), std::move(monitor)});
  }
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
  measure_.MoveTo(snapshot);
  const double now = base::ToSeconds(snapshot->state.time);
  for (Pending& pending : pending_) {
    if (pending.monitor.verdict()) continue;
    std::vector<bool> holds;
    for (MeasuredAtom& measured : pending.finding.atoms) {
      const auto value = measure_.Of(measured.atom.quantity);
      Note(value, now, measured);
      holds.push_back(Lies(measured.atom, value));
    }
    pending.monitor.Step(snapshot->state.time, simulation_.specification().step,
                         [&](int atom) { return holds[static_cast<std::size_t>(atom)]; });
    if (pending.monitor.verdict()) RecordVerdict(pending, snapshot);
  }
}

void Judge::RecordVerdict(Pending& pending,
                          const std::shared_ptr<const world::Snapshot>& snapshot) {
  pending.finding.holds = *pending.monitor.verdict();
  pending.finding.step = snapshot->state.step;
  pending.finding.time = snapshot->state.time;
  if (!pending.finding.holds && first_violation_ == nullptr) first_violation_ = snapshot;
}

std::vector<Finding> Judge::Finish() {
  const std::int64_t last = simulation_.snapshot()->state.step;
  base::MutexLock lock(mutex_);
  judged_.wait(lock, [&]() GSV_REQUIRES(mutex_) { return latest_->state.step >= last; });
  std::vector<Finding> findings;
  for (Pending& pending : pending_) {
    if (!pending.monitor.verdict()) {
      pending.monitor.End();
      RecordVerdict(pending, latest_);
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
