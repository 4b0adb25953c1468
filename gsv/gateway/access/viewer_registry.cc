#include "gsv/gateway/access/viewer_registry.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>

#include "gsv/base/sorting.h"

namespace gsv::gateway::access {
namespace {

constexpr std::size_t kMaxViewerNameLength = 60;  // bytes

std::string NewKey() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

// Returns the name as one line of limited length, without an incomplete character at its end.
std::string CleanName(const std::string& name) {
  std::string clean;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    clean.push_back(byte < 0x20 || byte == 0x7f ? ' ' : c);
  }
  if (clean.size() > kMaxViewerNameLength) {
    std::size_t end = kMaxViewerNameLength;
    while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xc0) == 0x80) --end;
    clean.resize(end);
  }
  const std::size_t first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') - first + 1);
}

std::string NameFor(const std::string& name, std::uint64_t number) {
  const std::string clean = CleanName(name);
  return clean.empty() ? "viewer " + std::to_string(number) : clean;
}

}  // namespace

base::Result<ViewerRegistry::Admission> ViewerRegistry::Enter(const std::string& name,
                                                              const std::string& simulation,
                                                              Time now) {
  const base::MutexLock lock(mutex_);
  Expire(now);
  if (viewers_.size() >= kMaxViewers) {
    return base::Fail(
        base::ErrorCode::kUnavailable,
        "cannot connect: 1000 viewers are connected already. Close some, then try again");
  }
  Admission admission{next_++, NewKey()};
  ++version_;
  viewers_[admission.key] = {{admission.number, NameFor(name, admission.number), simulation}, now};
  return admission;
}

base::Result<ViewerRegistry::Viewer*> ViewerRegistry::Find(const std::string& key, Time now) {
  Expire(now);
  const auto found = viewers_.find(key);
  if (found == viewers_.end()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "this viewer is not registered any more; reload the page");
  }
  found->second.seen = now;
  return &found->second;
}

base::Status ViewerRegistry::Rename(const std::string& key, const std::string& name, Time now) {
  const base::MutexLock lock(mutex_);
  const base::Result<Viewer*> viewer = Find(key, now);
  if (!viewer) return base::Fail(viewer.error());
  ViewerState& person = (*viewer)->person;
  person.name = NameFor(name, person.number);
  ++version_;
  return {};
}

base::Status ViewerRegistry::SelectSimulation(const std::string& key, const std::string& simulation,
                                              Time now) {
  const base::MutexLock lock(mutex_);
  const base::Result<Viewer*> viewer = Find(key, now);
  if (!viewer) return base::Fail(viewer.error());
  if ((*viewer)->person.simulation == simulation) return {};
  ReleaseControl(key);
  (*viewer)->person.simulation = simulation;
  ++version_;
  Expire(now);
  return {};
}

base::Status ViewerRegistry::Leave(const std::string& key, Time now) {
  const base::MutexLock lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  Forget(key);
  Expire(now);
  return {};
}

base::Status ViewerRegistry::RequestControl(const std::string& key, Time now) {
  const base::MutexLock lock(mutex_);
  const base::Result<Viewer*> viewer = Find(key, now);
  if (!viewer) return base::Fail(viewer.error());
  if ((*viewer)->person.simulation.empty()) {
    return base::Fail(base::ErrorCode::kNotRunning,
                      "no simulation is open; open one, then ask for control");
  }
  Control& control = ControlOf(**viewer);
  const bool asks = std::any_of(control.questions.begin(), control.questions.end(),
                                [&](const Question& question) { return question.key == key; });
  if (control.holder == key || asks) return {};
  control.questions.push_back({key, now});
  ++version_;
  Expire(now);
  return {};
}

base::Status ViewerRegistry::Release(const std::string& key, Time now) {
  const base::MutexLock lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  ReleaseControl(key);
  Expire(now);
  return {};
}

base::Status ViewerRegistry::Answer(const std::string& key, bool grants, Time now) {
  const base::MutexLock lock(mutex_);
  const base::Result<Viewer*> viewer = Find(key, now);
  if (!viewer) return base::Fail(viewer.error());
  Control& control = ControlOf(**viewer);
  if (control.holder != key || control.questions.empty()) {
    const bool holds = control.holder == key;
    return base::Fail(
        base::ErrorCode::kNotRunning,
        holds ? "no viewer asks for control" : "you do not have control; ask for it first");
  }
  ++version_;
  if (grants) {
    PassControl(control, now);
  } else {
    control.questions.pop_front();
    if (!control.questions.empty()) control.questions.front().asked = now;
  }
  return {};
}

ViewerRegistry::ViewerList ViewerRegistry::List(const std::string& key, Time now) {
  const base::MutexLock lock(mutex_);
  const base::Result<Viewer*> you = Find(key, now);
  ViewerList standing;
  if (you) standing.you = (*you)->person.number;
  for (const auto& [each, viewer] : viewers_) {
    ViewerState& person = standing.viewers.emplace_back(viewer.person);
    const auto found = controls_.find(person.simulation);
    if (found == controls_.end()) continue;
    const Control& control = found->second;
    person.holds = control.holder == each;
    for (std::size_t i = 0; i < control.questions.size(); ++i) {
      if (control.questions[i].key == each) person.asks = i + 1;
    }
    if (person.asks == 1) {
      person.left = std::chrono::duration_cast<std::chrono::milliseconds>(
          control.questions.front().asked + limits_.answer - now);
    }
  }
  base::Sort(standing.viewers,
             [](const ViewerState& a, const ViewerState& b) { return a.number < b.number; });
  return standing;
}

std::uint64_t ViewerRegistry::Version(Time now) {
  const base::MutexLock lock(mutex_);
  Expire(now);
  return version_;
}

base::Status ViewerRegistry::CheckControl(const std::string& key, const std::string& simulation,
                                          Time now) {
  const base::MutexLock lock(mutex_);
  (void)Find(key, now);
  const auto found = controls_.find(simulation);
  if (found == controls_.end()) return {};
  const std::string& holder = found->second.holder;
  if (holder.empty() || holder == key) return {};
  return base::Fail(base::ErrorCode::kNotRunning,
                    viewers_.at(holder).person.name + " has control; ask for control first");
}

void ViewerRegistry::Expire(Time now) {
  for (auto viewer = viewers_.begin(); viewer != viewers_.end();) {
    const auto next = std::next(viewer);
    if (now - viewer->second.seen > limits_.absence) Forget(std::string(viewer->first));
    viewer = next;
  }
  for (auto entry = controls_.begin(); entry != controls_.end();) {
    Control& control = entry->second;
    if (!control.questions.empty() &&
        (control.holder.empty() || now - control.questions.front().asked >= limits_.answer)) {
      PassControl(control, now);
      ++version_;
    }
    entry = control.holder.empty() ? controls_.erase(entry) : std::next(entry);
  }
}

void ViewerRegistry::Forget(const std::string& key) {
  ReleaseControl(key);
  viewers_.erase(key);
  ++version_;
}

void ViewerRegistry::ReleaseControl(const std::string& key) {
  const auto found = controls_.find(viewers_.at(key).person.simulation);
  if (found == controls_.end()) return;
  Control& control = found->second;
  std::erase_if(control.questions, [&](const Question& question) { return question.key == key; });
  if (control.holder == key) control.holder.clear();
  ++version_;
}

// Gives control to the first viewer in the queue. This viewer then has to answer the next request.
void ViewerRegistry::PassControl(Control& control, Time now) {
  control.holder = control.questions.front().key;
  control.questions.pop_front();
  if (!control.questions.empty()) control.questions.front().asked = now;
}

}  // namespace gsv::gateway::access
