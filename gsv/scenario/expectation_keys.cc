#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "gsv/scenario/scenario_keys.h"
#include "gsv/scenario/test_keys.h"

namespace gsv::scenario {
namespace {

using FormulaKind = Formula::Kind;
using QuantityKind = Quantity::Kind;

constexpr double kMax = 1e9;                    // maximum absolute value of a bound
constexpr double kNear = 0.25;                  // default tolerance of a position, m
constexpr double kYawNear = 0.261799387799149;  // default tolerance of a yaw, rad (15 degrees)
constexpr double kStuckAfterOfRun = -1;         // see Formula::min

Formula Atom(QuantityKind kind, std::string first, double least, double most) {
  Formula atom;
  atom.quantity.kind = kind;
  atom.quantity.first = std::move(first);
  atom.min = least;
  atom.max = most;
  return atom;
}

Formula Joined(FormulaKind kind, std::vector<Formula> parts) {
  Formula formula;
  formula.kind = kind;
  formula.parts = std::move(parts);
  return formula;
}

Formula Not(Formula formula) { return Joined(FormulaKind::kNot, {std::move(formula)}); }

class FormulaReader {
 public:
  explicit FormulaReader(const YamlPlace& place) : place_(place) {}

  // Reads the formula in `mapping`: one operator and its arguments.
  Formula Read(YamlMapping& mapping, int depth) {
    Formula formula;
    if (is_too_large()) return formula;
    const bool is_too_deep = depth > kMaxFormulaDepth;
    if (++count_ > kMaxFormulas || is_too_deep) {
      count_ = kMaxFormulas + 1;
      mapping.AddProblem(is_too_deep ? "conditions are nested more than 16 deep"
                                     : "the expectations have more than 1000 conditions in total");
      return formula;
    }
    std::string found;
    for (const Operator& each : kOperators) {
      const auto node = mapping.Any(each.key);
      if (!mapping.Has(each.key)) continue;
      if (!found.empty()) {
        mapping.AddProblem(
            each.key, "a condition has exactly one operator, found " + found + " and " + each.key);
        continue;
      }
      found = each.key;
      formula = (this->*each.read)(*node, mapping, each.key, depth);
    }
    formula.source.text = mapping.Source();
    if (mapping.is_mapping() && found.empty()) {
      std::string known;
      for (const Operator& each : kOperators)
        known += (known.empty() ? "" : ", ") + std::string(each.key);
      mapping.AddProblem("a condition has one operator of " + known);
    }
    ReadWindow(mapping, formula);
    return formula;
  }

  // Whether there are too many formulas. The problem is reported once, and reading stops.
  bool is_too_large() const { return count_ > kMaxFormulas; }

 private:
  using ReadOperator = Formula (FormulaReader::*)(const YAML::Node&, YamlMapping&,
                                                  const std::string&, int);
  struct Operator {
    const char* key;
    ReadOperator read;
  };
  static const std::array<Operator, 24> kOperators;

  Formula ReadNode(const YAML::Node& node, std::string field, int depth) {
    YamlMapping mapping(node, std::move(field), place_);
    return Read(mapping, depth);
  }

  void ReadWindow(YamlMapping& mapping, Formula& formula) {
    const auto from = mapping.Number("from", 0, kMaxDuration);
    const auto by = mapping.Number("by", 0, kMaxDuration);
    const bool is_temporal = formula.kind == FormulaKind::kAlways ||
                             formula.kind == FormulaKind::kEventually ||
                             formula.kind == FormulaKind::kUntil;
    if ((from || by) && !is_temporal) {
      mapping.AddProblem(
          from ? "from" : "by",
          "'from' and 'by' belong to expectations about time only: always, eventually, until, "
          "before, reaches, stays_within, never, never_collides, distance_at_least");
      return;
    }
    formula.from = from.value_or(0);
    formula.by = by;
    if (by && *by < formula.from) {
      mapping.AddProblem("by", "'by' is before 'from', so the time window is empty");
    }
  }

  Formula Always(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kAlways, {ReadNode(node, m.FieldOf(key), depth + 1)});
  }
  Formula Eventually(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kEventually, {ReadNode(node, m.FieldOf(key), depth + 1)});
  }
  Formula Negation(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Not(ReadNode(node, m.FieldOf(key), depth + 1));
  }

  std::vector<Formula> Several(const YAML::Node& node, YamlMapping& m, const std::string& key,
                               int depth, std::size_t exactly) {
    std::vector<Formula> parts;
    if (!node.IsSequence() || node.size() == 0 || (exactly > 0 && node.size() != exactly)) {
      m.AddProblem(key, key + " must be a list of " +
                            (exactly > 0 ? std::to_string(exactly) + " conditions" : "conditions"));
      parts.resize(exactly);
      return parts;
    }
    for (std::size_t i = 0; i < node.size() && !is_too_large(); ++i) {
      parts.push_back(ReadNode(node[i], m.FieldOf(key) + "[" + std::to_string(i) + "]", depth + 1));
    }
    parts.resize(std::max(parts.size(), exactly));
    return parts;
  }
  Formula All(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kAll, Several(node, m, key, depth, 0));
  }
  Formula Any(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kAny, Several(node, m, key, depth, 0));
  }
  Formula Implies(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    auto parts = Several(node, m, key, depth, 2);
    return Joined(FormulaKind::kAny, {Not(std::move(parts[0])), std::move(parts[1])});
  }
  Formula Until(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kUntil, Several(node, m, key, depth, 2));
  }
  // Reads `before: [first, second]`. `first` must become true at some instant. Until then, and at
  // that instant, `second` must be false.
  Formula Before(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    auto parts = Several(node, m, key, depth, 2);
    Formula none_of_second = Not(parts[1]);
    Formula first_alone = Joined(FormulaKind::kAll, {std::move(parts[0]), none_of_second});
    return Joined(FormulaKind::kUntil, {std::move(none_of_second), std::move(first_alone)});
  }

  // Reads the name of a robot or object.
  std::string Body(YamlMapping& m) {
    const auto name = m.Text("robot");
    if (m.is_mapping() && (!name || name->empty()))
      m.AddProblem("robot", "set robot to the name of a robot or an object");
    return name.value_or("");
  }

  void ReadBounds(YamlMapping& m, Formula& atom) {
    const auto least = m.Number("at_least", -kMax, kMax);
    const auto most = m.Number("at_most", -kMax, kMax);
    if (m.is_mapping() && !m.Has("at_least") && !m.Has("at_most")) {
      m.AddProblem("set at_least, at_most or both");
    }
    if (least) atom.min = *least;
    if (most) atom.max = *most;
    if (atom.min > atom.max) m.AddProblem("at_most", "at_most is less than at_least");
  }

  Formula Near(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping near(node, m.FieldOf(key), place_);
    Formula atom = Atom(QuantityKind::kDistanceToPoint, Body(near), 0, kNear);
    atom.quantity.x = near.Number("x", -kMaxCoordinate, kMaxCoordinate).value_or(0);
    atom.quantity.y = near.Number("y", -kMaxCoordinate, kMaxCoordinate).value_or(0);
    if (near.is_mapping() && !(near.Has("x") && near.Has("y")))
      near.AddProblem(near.Has("x") ? "y" : "x", "a place needs both x and y");
    atom.max = near.Number("within", 1e-6, kMaxCoordinate).value_or(kNear);
    const auto yaw = near.Angle("yaw");
    const auto yaw_within = near.Angle("yaw_within");
    if (!yaw) return atom;
    Formula heading =
        Atom(QuantityKind::kYawOff, atom.quantity.first, 0, yaw_within.value_or(kYawNear));
    heading.quantity.yaw = *yaw;
    return Joined(FormulaKind::kAll, {std::move(atom), std::move(heading)});
  }

  void ReadRange(YamlMapping& m, const std::string& key, QuantityKind kind,
                 const std::string& robot, std::vector<Formula>& atoms) {
    const std::vector<YAML::Node> ends = m.List(key);
    if (!m.Has(key)) return;
    const auto number = [&](const YAML::Node& node) {
      return node.IsScalar() ? ParseNumber(node.Scalar()) : std::nullopt;
    };
    const auto least = ends.size() == 2 ? number(ends[0]) : std::nullopt;
    const auto most = ends.size() == 2 ? number(ends[1]) : std::nullopt;
    if (!least || !most || *least > *most) {
      m.AddProblem(key, key + " must be two numbers, the smaller first, as in [-1, 2.5]");
      return;
    }
    atoms.push_back(Atom(kind, robot, *least, *most));
  }
  Formula Inside(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping region(node, m.FieldOf(key), place_);
    const std::string robot = Body(region);
    std::vector<Formula> atoms;
    ReadRange(region, "x", QuantityKind::kX, robot, atoms);
    ReadRange(region, "y", QuantityKind::kY, robot, atoms);
    ReadRange(region, "z", QuantityKind::kZ, robot, atoms);
    if (region.is_mapping() && !region.Has("x") && !region.Has("y") && !region.Has("z")) {
      region.AddProblem("set x, y or z, as in x: [-1, 2.5]");
    }
    return Joined(FormulaKind::kAll, std::move(atoms));
  }

  Formula Bounded(QuantityKind kind, const YAML::Node& node, YamlMapping& m,
                  const std::string& key) {
    YamlMapping of(node, m.FieldOf(key), place_);
    Formula atom = Atom(kind, Body(of), -kMax, kMax);
    ReadBounds(of, atom);
    return atom;
  }
  Formula Speed(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    return Bounded(QuantityKind::kSpeed, node, m, key);
  }
  Formula Turning(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    return Bounded(QuantityKind::kTurning, node, m, key);
  }
  Formula Travelled(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    return Bounded(QuantityKind::kTravelled, node, m, key);
  }

  void ReadPair(YamlMapping& m, Quantity& quantity) {
    const std::vector<std::string> names = m.Texts("between");
    if (!m.is_mapping()) return;
    if (names.size() != 2 || names[0].empty() || names[1].empty() || names[0] == names[1]) {
      m.AddProblem("between", "between must be two names, as in [scout, crate]");
      return;
    }
    quantity.first = names[0];
    quantity.second = names[1];
  }
  Formula Distance(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping of(node, m.FieldOf(key), place_);
    Formula atom = Atom(QuantityKind::kDistance, "", -kMax, kMax);
    ReadPair(of, atom.quantity);
    ReadBounds(of, atom);
    return atom;
  }
  Formula DistanceAtLeast(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping of(node, m.FieldOf(key), place_);
    Formula atom = Atom(QuantityKind::kDistance, "", 0, kMax);
    ReadPair(of, atom.quantity);
    const auto metres = of.Number("metres", 0, kMaxCoordinate);
    if (of.is_mapping() && !of.Has("metres")) of.AddProblem("metres", "set metres");
    atom.min = metres.value_or(0);
    return Joined(FormulaKind::kAlways, {std::move(atom)});
  }

  // Reads the name of one body, or a list of two names.
  Formula Contact(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    Formula atom = Atom(QuantityKind::kContact, "", 1, 1);
    const bool is_pair =
        node.IsSequence() && node.size() == 2 && node[0].IsScalar() && node[1].IsScalar();
    if (is_pair) {
      atom.quantity.first = node[0].Scalar();
      atom.quantity.second = node[1].Scalar();
    } else if (node.IsScalar()) {
      atom.quantity.first = node.Scalar();
    } else {
      m.AddProblem(key, key + " must be a name, or two as in [scout, crate]");
    }
    return atom;
  }
  Formula NeverCollides(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kAlways, {Not(Contact(node, m, key, depth))});
  }
  // Reads a robot's name, or {robot, after}. Without a robot, the formula applies to all robots.
  Formula Stuck(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    Formula atom = Atom(QuantityKind::kStuck, "", kStuckAfterOfRun, kMax);
    if (node.IsScalar()) {
      atom.quantity.first = node.Scalar();
      return atom;
    }
    YamlMapping of(node, m.FieldOf(key), place_);
    atom.quantity.first = of.Text("robot").value_or("");
    if (const auto after = of.Number("after", 0.1, kMaxDuration)) atom.min = *after;
    return atom;
  }
  // Reads `never`. `never: stuck` applies to all robots.
  Formula Never(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    Formula condition;
    if (!node.IsScalar()) {
      condition = ReadNode(node, m.FieldOf(key), depth + 1);
    } else if (node.Scalar() == "stuck") {
      condition = Atom(QuantityKind::kStuck, "", kStuckAfterOfRun, kMax);
    } else {
      m.AddProblem(key, "never must be stuck or a condition, as in never: {contact: scout}");
    }
    return Joined(FormulaKind::kAlways, {Not(std::move(condition))});
  }
  Formula Ended(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    if (!node.IsScalar()) m.AddProblem(key, key + " must be a robot's name");
    return Atom(QuantityKind::kEnded, node.IsScalar() ? node.Scalar() : "", 1, 1);
  }

  Formula Sensor(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping of(node, m.FieldOf(key), place_);
    // Ranges may be infinite (docs/sensors.md).
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Formula atom = Atom(QuantityKind::kSensor, "", -kInfinity, kInfinity);
    const std::string name = of.Text("of").value_or("");
    const std::size_t slash = std::min(name.find('/'), name.size());
    atom.quantity.first = name.substr(0, slash);
    atom.quantity.second = name.substr(std::min(slash + 1, name.size()));
    if (of.is_mapping() && (atom.quantity.first.empty() || atom.quantity.second.empty()))
      of.AddProblem("of", "of must be a sensor, as in scout/front");
    const auto take = of.Text("take");
    const auto value = of.Number("value", 0, 1e6);
    if (take && value) of.AddProblem("value", "give either 'take' or 'value', not both");
    if (value) {
      atom.quantity.take = Quantity::Take::kOne;
      atom.quantity.value = static_cast<int>(*value);
    } else if (take == "max") {
      atom.quantity.take = Quantity::Take::kMax;
    } else if (take == "mean") {
      atom.quantity.take = Quantity::Take::kMean;
    } else if (take && take != "min") {
      of.AddProblem("take", "take must be min, max or mean, found \"" + *take + "\"");
    }
    ReadBounds(of, atom);
    return atom;
  }

  Formula Time(const YAML::Node& node, YamlMapping& m, const std::string& key, int) {
    YamlMapping of(node, m.FieldOf(key), place_);
    Formula atom = Atom(QuantityKind::kTime, "", 0, kMax);
    ReadBounds(of, atom);
    return atom;
  }

  Formula Reaches(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kEventually, {Near(node, m, key, depth)});
  }
  Formula StaysWithin(const YAML::Node& node, YamlMapping& m, const std::string& key, int depth) {
    return Joined(FormulaKind::kAlways, {Inside(node, m, key, depth)});
  }

  const YamlPlace& place_;
  int count_ = 0;
};

const std::array<FormulaReader::Operator, 24> FormulaReader::kOperators = {{
    {"reaches", &FormulaReader::Reaches},
    {"stays_within", &FormulaReader::StaysWithin},
    {"never_collides", &FormulaReader::NeverCollides},
    {"distance_at_least", &FormulaReader::DistanceAtLeast},
    {"never", &FormulaReader::Never},
    {"before", &FormulaReader::Before},
    {"always", &FormulaReader::Always},
    {"eventually", &FormulaReader::Eventually},
    {"until", &FormulaReader::Until},
    {"all", &FormulaReader::All},
    {"any", &FormulaReader::Any},
    {"not", &FormulaReader::Negation},
    {"implies", &FormulaReader::Implies},
    {"near", &FormulaReader::Near},
    {"inside", &FormulaReader::Inside},
    {"speed", &FormulaReader::Speed},
    {"turning", &FormulaReader::Turning},
    {"travelled", &FormulaReader::Travelled},
    {"distance", &FormulaReader::Distance},
    {"contact", &FormulaReader::Contact},
    {"stuck", &FormulaReader::Stuck},
    {"sensor", &FormulaReader::Sensor},
    {"ended", &FormulaReader::Ended},
    {"time", &FormulaReader::Time},
}};

}  // namespace

std::vector<Expectation> ReadExpectations(YamlMapping& scenario, double duration) {
  std::vector<Expectation> expectations;
  FormulaReader reader(scenario.place());
  scenario.Each("expect", kMaxFormulas, [&](const YAML::Node& node, std::string field) {
    if (reader.is_too_large()) return;
    const std::size_t problem_count = scenario.place().problem_count();
    YamlMapping mapping(node, std::move(field), scenario.place());
    Expectation expectation;
    const auto name = mapping.Text("name");
    expectation.source.text = mapping.Source();
    expectation.formula = reader.Read(mapping, 1);
    if (expectation.formula.by.value_or(0) > duration && duration > 0)
      mapping.AddProblem("by", "'by' is after the end of the run (duration)");
    if (expectation.formula.from > duration && duration > 0)
      mapping.AddProblem("from", "'from' is after the end of the run (duration)");
    if (scenario.place().problem_count() == problem_count) expectation.yaml = OneLineYaml(node);
    expectation.name = name.value_or(expectation.yaml);
    expectations.push_back(std::move(expectation));
  });
  if (!expectations.empty() && duration == 0) {
    scenario.AddProblem("expect", "expectations need an end of the run: set duration");
  }
  return expectations;
}

}  // namespace gsv::scenario
