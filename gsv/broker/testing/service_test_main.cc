// For tests: the service of an offer in its own process. It exports itself as a "Service" to the
// broker in its argument, prints the offer's id, and serves until its parent ends.
#include <csignal>
#include <cstdio>

#include <sys/prctl.h>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/client/broker_client.h"

namespace {

class Service : public POA_CosTradingDynamic::DynamicPropEval {
 public:
  CORBA::Any* evalDP(const char*, CORBA::TypeCode_ptr, const CORBA::Any&) override {
    return new CORBA::Any;
  }
};

int PrintError(const gsv::base::Error& error) {
  std::fprintf(stderr, "%s\n", error.Sentence().c_str());
  return 5;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const char* settings[][2] = {
      {"endPoint", "giop:tcp:127.0.0.1:"}, {"traceLevel", "0"}, {nullptr, nullptr}};
  int no_arguments = 0;
  const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
  const CORBA::Object_var object = orb->resolve_initial_references("RootPOA");
  const PortableServer::POA_var poa = PortableServer::POA::_narrow(object);
  PortableServer::POAManager_var(poa->the_POAManager())->activate();
  const CORBA::Object_var service = (new Service)->_this();

  auto broker = gsv::broker::BrokerClient::Connect(orb, argv[1]);
  if (!broker) return PrintError(broker.error());
  if (auto ok = broker->EnsureServiceType({.name = "Service"}); !ok) return PrintError(ok.error());
  const auto id = broker->Export("Service", service, {});
  if (!id) return PrintError(id.error());
  std::printf("%s\n", id->c_str());
  std::fflush(stdout);
  orb->run();
  return 0;
}
