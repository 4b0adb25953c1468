#include "gsv/orb/transport/connection_policy.h"

#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::orb {
namespace {

struct Current {
  base::Mutex mutex;
  std::shared_ptr<const ConnectionPolicy> policy GSV_GUARDED_BY(mutex) =
      std::make_shared<ConnectionPolicy>();
};
Current& CurrentPolicy() {
  // never destroyed, because an ORB may outlive static objects
  static auto& current = *new Current;
  return current;
}

}  // namespace

void SetConnectionPolicy(ConnectionPolicy policy) {
  auto made = std::make_shared<const ConnectionPolicy>(std::move(policy));
  Current& current = CurrentPolicy();
  const base::MutexLock lock(current.mutex);
  current.policy = std::move(made);
}

std::shared_ptr<const ConnectionPolicy> CurrentConnectionPolicy() {
  Current& current = CurrentPolicy();
  const base::MutexLock lock(current.mutex);
  return current.policy;
}

}  // namespace gsv::orb
