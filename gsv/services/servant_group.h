// A group of CORBA objects that are deactivated together.
//
// Threads  any.
#pragma once

#include <set>
#include <string>

#include "gsv/base/mutex.h"

#include "idl/hardware.hh"

namespace gsv::services {

// The objects of one robot's hardware. After DeactivateAll(), calls get OBJECT_NOT_EXIST.
class ServantGroup {
 public:
  explicit ServantGroup(PortableServer::POA_ptr poa);

  // Takes ownership of the servant and returns a reference. Throws sba::Ended after
  // DeactivateAll().
  template <typename Interface>
  typename Interface::_ptr_type Activate(PortableServer::ServantBase* servant) {
    const CORBA::Object_var object = Adopt(servant, nullptr);
    return Interface::_narrow(object);
  }
  // Activates a servant under a reference of type `Interface`. The servant may implement a derived
  // interface; older clients know only `Interface`.
  template <typename Interface>
  typename Interface::_ptr_type ActivateAs(PortableServer::ServantBase* servant) {
    const CORBA::Object_var object = Adopt(servant, Interface::_PD_repoId);
    return Interface::_narrow(object);
  }
  void Deactivate(PortableServer::ServantBase* servant);
  void DeactivateAll();

 private:
  // `type` is a repository id; null means the id of the servant's own type.
  CORBA::Object_ptr Adopt(PortableServer::ServantBase* servant, const char* type);
  void DeactivateId(const std::string& id);

  PortableServer::POA_var poa_;
  base::Mutex mutex_;
  std::set<std::string> ids_ GSV_GUARDED_BY(mutex_);  // object ids of the group's objects
  bool closed_ GSV_GUARDED_BY(mutex_) = false;        // whether DeactivateAll() was called
};

}  // namespace gsv::services
