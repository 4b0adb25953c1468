#include "gsv/broker/broker.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <random>
#include <thread>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include "gsv/base/mutex.h"
#include "gsv/broker/service/admin_servant.h"
#include "gsv/broker/service/link_servant.h"
#include "gsv/broker/service/liveness.h"
#include "gsv/broker/service/lookup_servant.h"
#include "gsv/broker/service/proxy_servant.h"
#include "gsv/broker/service/register_servant.h"
#include "gsv/broker/service/trading_objects.h"
#include "gsv/broker/service/type_repository_servant.h"
#include "gsv/broker/storage/offer_file.h"
#include "gsv/broker/trader/service_reference.h"
#include "gsv/broker/transport/broker_connections.h"
#include "gsv/broker/transport/process_limits.h"
#include "gsv/orb/corba_access.h"

namespace gsv::broker {
namespace {

constexpr const char* kKey = "TradingService";

constexpr unsigned long kThreadStackBytes = 1ul << 20;

CORBA::ORB_ptr StartOrb(const orb::OrbAccess& access) {
  // The reasons for these settings are in docs/broker.md.
  const char* settings[][2] = {
      {"endPoint", access.endpoint.c_str()},
      {"clientTransportRule", access.client_rules[0]},
      {"clientTransportRule", access.client_rules[1]},
      {"giopMaxMsgSize", "65536"},
      {"threadPerConnectionPolicy", "1"},
      {"threadPerConnectionUpperLimit", "256"},
      {"threadPerConnectionLowerLimit", "200"},
      {"maxServerThreadPerConnection", "2"},
      {"maxServerThreadPoolSize", "32"},
      // After a request, a thread of the pool serves the next waiting connection at once. With "1",
      // it would wait for a further request on its connection and so delay the others.
      {"threadPoolWatchConnection", "0"},
      {"inConScanPeriod", "180"},
      {"outConScanPeriod", "60"},
      {"scanGranularity", "5"},
      {"serverCallTimeOutPeriod", "3000"},
      {"clientCallTimeOutPeriod", "2000"},
      // "0" means no separate time limit for connecting. If a call has to connect first, such a
      // limit would replace the limit of the call.
      {"clientConnectTimeOutPeriod", "0"},
      {"supportPerThreadTimeOut", "1"},
      {"verifyObjectExistsAndType", "0"},
      {"maxGIOPConnectionPerServer", "16"},
      {"strictIIOP", "0"},  // the reason is in gsv/orb/orb.cc
      {"traceLevel", "0"},
      {nullptr, nullptr},
  };
  orb::SetConnectionPolicy(BrokerConnectionPolicy(MaxConnections()));
  omni_thread::stacksize(kThreadStackBytes);
  // The threads get large stacks, because those that query other traders read large replies.
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kThreadStackBytes);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  int no_arguments = 0;
  return CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
}

// Returns the reason why the endpoint could not be opened, because omniORB does not report it.
std::string WhyNotListening(const BrokerOptions& options) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(options.port);
  const char* host = options.host.empty() ? nullptr : options.host.c_str();
  if (const int failure = getaddrinfo(host, port.c_str(), &hints, &found); failure != 0) {
    return fmt::format("the address is not known ({})", gai_strerror(failure));
  }
  const int socket = ::socket(found->ai_family, SOCK_STREAM, 0);
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const bool bound = bind(socket, found->ai_addr, found->ai_addrlen) == 0 && listen(socket, 1) == 0;
  const int reason = errno;
  close(socket);
  freeaddrinfo(found);
  if (bound) return "the ORB cannot listen here";
  if (reason == EADDRINUSE) {
    return fmt::format("port {} is in use; choose another, or 0 for any free port", options.port);
  }
  return fmt::format("cannot open the port: {}", std::strerror(reason));
}

PortableServer::POA_ptr IteratorPoa(PortableServer::POA_ptr root, const char* name,
                                    PortableServer::ServantBase* servant) {
  CORBA::PolicyList policies;
  policies.length(4);
  policies[0] = root->create_request_processing_policy(PortableServer::USE_DEFAULT_SERVANT);
  policies[1] = root->create_servant_retention_policy(PortableServer::NON_RETAIN);
  policies[2] = root->create_id_assignment_policy(PortableServer::USER_ID);
  policies[3] = root->create_id_uniqueness_policy(PortableServer::MULTIPLE_ID);
  const PortableServer::POAManager_var manager = root->the_POAManager();
  PortableServer::POA_var poa = root->create_POA(name, manager, policies);
  poa->set_servant(servant);
  servant->_remove_ref();
  return poa._retn();
}

// Activates `servant` under its own key. The POA then owns the servant.
template <typename Interface, typename Servant>
typename Interface::_ptr_type Activate(PortableServer::POA_ptr poa, const char* key,
                                       Servant* servant) {
  const PortableServer::ObjectId_var id = PortableServer::string_to_ObjectId(key);
  poa->activate_object_with_id(id, servant);
  servant->_remove_ref();
  const CORBA::Object_var object = poa->id_to_reference(id);
  return Interface::_narrow(object);
}

}  // namespace

class Broker::Impl {
 public:
  Impl(const BrokerOptions& options, const orb::OrbAccess& access)
      : objects_(options.limits, std::random_device()(), std::random_device()()) {
    objects_.orb = StartOrb(access);
  }

  ~Impl() {
    {
      const base::MutexLock lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    if (reaper_.joinable()) reaper_.join();
    liveness_.reset();
    objects_.orb->destroy();
  }

  const std::string& reference() const { return reference_; }
  std::uint16_t port() const { return port_; }
  void Close() { objects_.trader.Close(); }

  // Restores the state from the file, and stores later changes in the file.
  base::Status Remember(const std::string& path) {
    auto file = OfferFile::Open(path, objects_.trader.stem());
    if (!file) return base::Fail(file.error());
    auto state = (*file)->Load();
    if (!state) return base::Fail(state.error());
    auto restored = objects_.trader.Restore(std::move(*state), std::move(*file));
    if (!restored) return base::Fail(restored.error().code, restored.error().message, path);
    return {};
  }

  void Serve(const BrokerOptions& options) {
    CORBA::Object_var object = objects_.orb->resolve_initial_references("RootPOA");
    const PortableServer::POA_var root = PortableServer::POA::_narrow(object);
    objects_.offer_iterators = IteratorPoa(root, "offers", new OfferIteratorServant(objects_));
    objects_.id_iterators = IteratorPoa(root, "ids", new OfferIdIteratorServant(objects_));

    object = objects_.orb->resolve_initial_references("omniINSPOA");
    const PortableServer::POA_var poa = PortableServer::POA::_narrow(object);
    objects_.types = Activate<CosTradingRepos::ServiceTypeRepository>(
        poa, "TradingTypes", new TypeRepositoryServant(objects_.trader));
    objects_.admin = Activate<CosTrading::Admin>(poa, "TradingAdmin", new AdminServant(objects_));
    objects_.link = Activate<CosTrading::Link>(poa, "TradingLink", new LinkServant(objects_));
    objects_.proxy = Activate<CosTrading::Proxy>(poa, "TradingProxy", new ProxyServant(objects_));
    objects_.registry =
        Activate<CosTrading::Register>(poa, "TradingRegister", new RegisterServant(objects_));
    objects_.lookup = Activate<CosTrading::Lookup>(poa, kKey, new LookupServant(objects_));

    const CORBA::String_var ior = objects_.orb->object_to_string(objects_.lookup);
    const auto address = ReadReference(ior.in());
    if (!address) throw CORBA::INTERNAL(0, CORBA::COMPLETED_NO);
    port_ = address->port;
    reference_ = fmt::format("corbaloc:{}:1.2@{}/{}", address->takes_tls ? "ssliop" : "",
                             address->Address(), kKey);

    PortableServer::POAManager_var(root->the_POAManager())->activate();
    PortableServer::POAManager_var(poa->the_POAManager())->activate();
    liveness_.emplace(options.liveness, objects_.trader,
                      [this](const std::string& reference, std::chrono::milliseconds timeout) {
                        return CheckLiveness(objects_.orb, reference, timeout);
                      });
    reaper_ = std::thread([this, period = options.limits.iterator_lifetime] { Reap(period); });
  }

 private:
  // Removes unused iterators periodically, even if no client requests new ones.
  void Reap(std::chrono::seconds period) {
    base::MutexLock lock(mutex_);
    while (!changed_.wait_for(lock, period, [this]() GSV_REQUIRES(mutex_) { return ending_; })) {
      objects_.offer_cursors.Expire();
      objects_.id_cursors.Expire();
    }
  }

  TradingObjects objects_;
  std::string reference_;
  std::uint16_t port_ = 0;
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  bool ending_ GSV_GUARDED_BY(mutex_) = false;
  std::thread reaper_;
  std::optional<LivenessMonitor> liveness_;
};

base::Result<std::unique_ptr<Broker>> Broker::Start(const BrokerOptions& options) {
  const auto access = orb::PrepareAccess(options.host, options.port);
  if (!access) return base::Fail(access.error());
  try {
    auto impl = std::make_unique<Impl>(options, *access);
    if (!options.data_file.empty()) {
      if (auto ok = impl->Remember(options.data_file); !ok) return base::Fail(ok.error());
    }
    impl->Serve(options);
    return std::unique_ptr<Broker>(new Broker(std::move(impl)));
  } catch (const CORBA::Exception&) {
    return base::Fail(base::ErrorCode::kUnavailable, WhyNotListening(options),
                      fmt::format("broker at {}:{}", options.host, options.port));
  }
}

Broker::Broker(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Broker::~Broker() = default;

const std::string& Broker::reference() const { return impl_->reference(); }
std::uint16_t Broker::port() const { return impl_->port(); }
void Broker::Close() { impl_->Close(); }

}  // namespace gsv::broker
