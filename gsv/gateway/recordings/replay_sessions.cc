#include "gsv/gateway/recordings/replay_sessions.h"

#include <utility>

namespace gsv::gateway::recordings {
namespace {

constexpr const char* kGone =
    "this replay has ended, as nobody watched it; open the recording again";

}  // namespace

bool IsOfReplaySession(const Target& target) {
  return target.segments.size() > 2 && target.segments[0] == "replays";
}

base::Result<std::string> ReplaySessions::Open(const std::string& path,
                                               const std::string& recording) {
  auto player = ReplayPlayer::Open(path, {});
  if (!player) return base::Fail(player.error());
  const std::map<std::string, Entry> unwatched = TakeUnwatched();
  const std::lock_guard lock(mutex_);
  if (is_stopped_) return base::Fail(base::ErrorCode::kUnavailable, "the server is shutting down");
  if (sessions_.size() >= limits_.sessions) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "so many recordings are watched here that no more can be opened; close a "
                      "page, and try again in half a minute");
  }
  const std::string name = std::to_string(next_++);
  sessions_[name] = {std::make_shared<Session>(*std::move(player), recording),
                     std::chrono::steady_clock::now()};
  return name;
}

std::map<std::string, ReplaySessions::Entry> ReplaySessions::TakeUnwatched() {
  const auto now = std::chrono::steady_clock::now();
  std::map<std::string, Entry> unwatched;
  const std::lock_guard lock(mutex_);
  for (auto entry = sessions_.begin(); entry != sessions_.end();) {
    const auto next = std::next(entry);
    // Who watches it, or asks it something, holds it as well.
    if (entry->second.session.use_count() > 1) {
      entry->second.used = now;
    } else if (now - entry->second.used > limits_.unwatched) {
      unwatched.insert(sessions_.extract(entry));
    }
    entry = next;
  }
  return unwatched;
}

std::shared_ptr<ReplaySessions::Session> ReplaySessions::Find(const Target& target) {
  const std::lock_guard lock(mutex_);
  const auto found =
      IsOfReplaySession(target) ? sessions_.find(target.segments[1]) : sessions_.end();
  if (found == sessions_.end()) return nullptr;
  found->second.used = std::chrono::steady_clock::now();
  return found->second.session;
}

Response ReplaySessions::Handle(const Request& request) {
  (void)TakeUnwatched();
  const std::shared_ptr<Session> session = Find(request.target);
  if (!session) return ErrorResponse(404, kGone);
  Request inner = request;
  inner.target.segments.erase(inner.target.segments.begin(), inner.target.segments.begin() + 2);
  if (inner.target.segments.front() != "api") {
    return ErrorResponse(404, "there is nothing at this address; a replay is at api/ and ws");
  }
  return session->api.Handle(inner);
}

base::Result<std::shared_ptr<Hub>> ReplaySessions::FindHub(const Target& target) {
  const std::shared_ptr<Session> session = Find(target);
  if (!session) return base::Fail(base::ErrorCode::kNotFound, kGone);
  return std::shared_ptr<Hub>(session, session->player->hub().get());
}

void ReplaySessions::Stop() {
  std::map<std::string, Entry> sessions;
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    sessions.swap(sessions_);
  }
  for (const auto& [name, entry] : sessions) entry.session->player->Stop();
}

}  // namespace gsv::gateway::recordings
