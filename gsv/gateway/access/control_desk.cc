#include "gsv/gateway/access/control_desk.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>

namespace gsv::gateway::access {
namespace {

constexpr std::size_t kLongestName = 60;  // bytes

std::string NewKey() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

// One line, not too long, and no half of a character at its end.
std::string CleanName(const std::string& name) {
  std::string clean;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    clean.push_back(byte < 0x20 || byte == 0x7f ? ' ' : c);
  }
  if (clean.size() > kLongestName) {
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(clean[end]) & 0xc0) == 0x80) --end;
    clean.resize(end);
  }
  const std::size_t first = clean.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return clean.substr(first, clean.find_last_not_of(' ') - first + 1);
}

}  // namespace

base::Result<ControlDesk::Admission> ControlDesk::Enter(const std::string& name, Time now) {
  const std::lock_guard lock(mutex_);
  Settle(now);
  if (viewers_.size() >= kMostViewers) {
    return base::Fail(base::ErrorCode::kUnavailable, "a thousand people are watching already");
  }
  Admission admission{next_++, NewKey()};
  std::string clean = CleanName(name);
  if (clean.empty()) clean = "viewer " + std::to_string(admission.number);
  viewers_[admission.key] = {{admission.number, std::move(clean)}, now};
  return admission;
}

base::Result<ControlDesk::Viewer*> ControlDesk::Find(const std::string& key, Time now) {
  Settle(now);
  const auto found = viewers_.find(key);
  if (found == viewers_.end()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "this viewer is not known here, any more; say your name again");
  }
  found->second.seen = now;
  return &found->second;
}

base::Status ControlDesk::Rename(const std::string& key, const std::string& name, Time now) {
  const std::lock_guard lock(mutex_);
  const base::Result<Viewer*> viewer = Find(key, now);
  if (!viewer) return base::Fail(viewer.error());
  const std::string clean = CleanName(name);
  Person& person = (*viewer)->person;
  person.name = clean.empty() ? "viewer " + std::to_string(person.number) : clean;
  return {};
}

base::Status ControlDesk::Leave(const std::string& key, Time now) {
  const std::lock_guard lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  Forget(key);
  Settle(now);
  return {};
}

base::Status ControlDesk::Ask(const std::string& key, Time now) {
  const std::lock_guard lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  const bool asks = std::any_of(questions_.begin(), questions_.end(),
                                [&](const Question& question) { return question.key == key; });
  if (holder_ != key && !asks) questions_.push_back({key, now});
  Settle(now);
  return {};
}

base::Status ControlDesk::Release(const std::string& key, Time now) {
  const std::lock_guard lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  std::erase_if(questions_, [&](const Question& question) { return question.key == key; });
  if (holder_ == key) holder_.clear();
  Settle(now);
  return {};
}

base::Status ControlDesk::Answer(const std::string& key, bool grants, Time now) {
  const std::lock_guard lock(mutex_);
  if (const auto viewer = Find(key, now); !viewer) return base::Fail(viewer.error());
  if (holder_ != key || questions_.empty()) {
    return base::Fail(base::ErrorCode::kNotRunning,
                      holder_ != key ? "you do not hold control" : "nobody asks for control");
  }
  if (grants) {
    PassOn(now);
  } else {
    questions_.pop_front();
    if (!questions_.empty()) questions_.front().asked = now;
  }
  return {};
}

ControlDesk::Standing ControlDesk::See(const std::string& key, Time now) {
  const std::lock_guard lock(mutex_);
  (void)Find(key, now);
  Standing standing;
  for (const auto& [each, viewer] : viewers_) standing.viewers.push_back(viewer.person);
  std::sort(standing.viewers.begin(), standing.viewers.end(),
            [](const Person& a, const Person& b) { return a.number < b.number; });
  standing.you = NumberOf(key);
  standing.holder = NumberOf(holder_);
  for (const Question& question : questions_) standing.asking.push_back(NumberOf(question.key));
  if (!questions_.empty()) {
    standing.left = std::chrono::duration_cast<std::chrono::milliseconds>(questions_.front().asked +
                                                                          limits_.answer - now);
  }
  return standing;
}

base::Status ControlDesk::MayAct(const std::string& key, Time now) {
  const std::lock_guard lock(mutex_);
  (void)Find(key, now);
  if (holder_.empty() || holder_ == key) return {};
  return base::Fail(base::ErrorCode::kNotRunning,
                    viewers_.at(holder_).person.name + " holds control; ask for it");
}

void ControlDesk::Settle(Time now) {
  for (auto viewer = viewers_.begin(); viewer != viewers_.end();) {
    const auto next = std::next(viewer);
    if (now - viewer->second.seen > limits_.absence) Forget(std::string(viewer->first));
    viewer = next;
  }
  if (questions_.empty()) return;
  if (holder_.empty() || now - questions_.front().asked >= limits_.answer) PassOn(now);
}

void ControlDesk::Forget(const std::string& key) {
  std::erase_if(questions_, [&](const Question& question) { return question.key == key; });
  if (holder_ == key) holder_.clear();
  viewers_.erase(key);
}

// The next question is a new holder's to answer.
void ControlDesk::PassOn(Time now) {
  holder_ = questions_.front().key;
  questions_.pop_front();
  if (!questions_.empty()) questions_.front().asked = now;
}

std::uint64_t ControlDesk::NumberOf(const std::string& key) const {
  const auto found = viewers_.find(key);
  return found == viewers_.end() ? 0 : found->second.person.number;
}

}  // namespace gsv::gateway::access
