#include "sdk/shared_orb.h"

#include "gsv/base/mutex.h"
#include "gsv/broker/client/corbaloc.h"
#include "gsv/orb/orb.h"
#include "sdk/fault_delay.h"

namespace gsv::sdk {
namespace {

// Protects the start and the end of the process's only ORB, which all users share.
base::Mutex shared_orb_mutex;
std::weak_ptr<SharedOrb> shared_orb;

base::Result<CORBA::ORB_var> StartOrbTowards(const std::string& broker) {
  orb::OrbOptions options;
  options.local_socket = true;
  auto reference = broker::NormaliseReference(broker);
  if (!reference) return base::Fail(reference.error());
  if (const std::string host = broker::HostOf(*reference); !host.empty()) {
    auto local = orb::LocalAddressTowards(host);
    if (!local) return base::Fail(local.error());
    options.host = *local;
  }
  return orb::StartOrb(options);
}

}  // namespace

base::Result<std::shared_ptr<SharedOrb>> SharedOrb::Towards(const std::string& broker) {
  // destroyed after the lock is released, because its destructor takes the lock
  std::shared_ptr<SharedOrb> shared;
  const base::MutexLock lock(shared_orb_mutex);
  shared = shared_orb.lock();
  if (shared != nullptr) return shared;
  auto orb = StartOrbTowards(broker);
  if (!orb) return base::Fail(orb.error());
  shared.reset(new SharedOrb(*orb));
  static const base::Status delayed = DelayCallsFromEnvironment();  // once per process
  if (!delayed) return base::Fail(delayed.error());
  shared_orb = shared;
  return shared;
}

SharedOrb::~SharedOrb() {
  const base::MutexLock lock(shared_orb_mutex);
  orb_->shutdown(true);
  orb_->destroy();
}

}  // namespace gsv::sdk
