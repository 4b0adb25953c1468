#include "gsv/gateway/recordings/replay_sessions.h"

#include <utility>

#include "gsv/gateway/drawing/pushed_views.h"

namespace gsv::gateway::recordings {
namespace {

constexpr const char* kGone =
    "this replay has ended because no viewer watched it; open the recording again";

}  // namespace

base::Result<std::string> ReplaySessions::Open(const std::string& path,
                                               const std::string& recording) {
  auto player = ReplayPlayer::Open(path, {});
  if (!player) return base::Fail(player.error());
  return Add(*std::move(player), recording);
}

base::Result<std::string> ReplaySessions::Add(std::unique_ptr<ReplayPlayer> player,
                                              const std::string& recording) {
  const std::map<std::string, Entry> unwatched = TakeUnwatched();
  const base::MutexLock lock(mutex_);
  if (is_stopped_) return base::Fail(base::ErrorCode::kUnavailable, "the server is shutting down");
  if (sessions_.size() >= limits_.sessions) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "too many recordings are open; close a page, and try again in half a minute");
  }
  const std::string name = std::to_string(next_++);
  sessions_[name] = {{std::move(player), recording}, std::chrono::steady_clock::now()};
  return name;
}

std::map<std::string, ReplaySessions::Entry> ReplaySessions::TakeUnwatched() {
  const auto now = std::chrono::steady_clock::now();
  std::map<std::string, Entry> unwatched;
  const base::MutexLock lock(mutex_);
  for (auto entry = sessions_.begin(); entry != sessions_.end();) {
    const auto next = std::next(entry);
    // While a viewer watches the session or sends it a request, others also hold the player.
    if (entry->second.replay.player.use_count() > 1) {
      entry->second.used = now;
    } else if (now - entry->second.used > limits_.unwatched) {
      unwatched.insert(sessions_.extract(entry));
    }
    entry = next;
  }
  return unwatched;
}

base::Result<drawing::ViewedWorld> ReplaySessions::FindViewed(const std::string& name) {
  const auto replay = Find(name);
  if (!replay) return base::Fail(replay.error());
  return drawing::ViewedWorld{"replays/" + name, replay->player, [player = replay->player] {
                                return drawing::MakeReplaySource(player);
                              }};
}

base::Result<Replay> ReplaySessions::Find(const std::string& name) {
  const base::MutexLock lock(mutex_);
  const auto found = sessions_.find(name);
  if (found == sessions_.end()) return base::Fail(base::ErrorCode::kNotFound, kGone);
  found->second.used = std::chrono::steady_clock::now();
  return found->second.replay;
}

std::vector<Route> ReplaySessions::Routes(drawing::ViewDrawer& drawer) {
  const std::string below = "/replays/{session}";
  std::vector<Route> routes = ReplayRoutes([this](const Request& request) {
    (void)TakeUnwatched();
    return Find(request.Parameter("session"));
  });
  for (Route& route : routes) {
    route.pattern = below + route.pattern;
    route.permission = Permission::kWatch;
    route.needs_control = false;
  }
  routes.push_back(SocketRoute(
      below + "/ws", false,
      [this, &drawer](const Request& request) -> base::Result<std::shared_ptr<Hub>> {
        const std::string& session = request.Parameter("session");
        auto hub = FindHub(session);
        if (!hub) return hub;
        (*hub)->Offer(std::make_shared<drawing::PushedViews>(
            drawer, [this, session] { return FindViewed(session); }));
        return hub;
      },
      "Open the live stream of your replay"));
  return routes;
}

base::Result<std::shared_ptr<Hub>> ReplaySessions::FindHub(const std::string& name) {
  const base::Result<Replay> replay = Find(name);
  if (!replay) return base::Fail(replay.error());
  return std::shared_ptr<Hub>(replay->player, replay->player->hub().get());
}

void ReplaySessions::Stop() {
  std::map<std::string, Entry> sessions;
  {
    const base::MutexLock lock(mutex_);
    is_stopped_ = true;
    sessions.swap(sessions_);
  }
  for (const auto& [name, entry] : sessions) entry.replay.player->Stop();
}

}  // namespace gsv::gateway::recordings
