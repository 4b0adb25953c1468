// CORBA objects that come and go together.
//
// Threads  any.
#pragma once

#include <set>
#include <string>

#include "gsv/base/mutex.h"

#include "idl/hardware.hh"

namespace gsv::services {

// The objects that belong to one robot's hardware. Its owner ends them together; whoever calls them
// afterwards gets OBJECT_NOT_EXIST.
class ServantGroup {
 public:
  explicit ServantGroup(PortableServer::POA_ptr poa);

  // Takes the servant over and gives a reference to it. Raises sba::Ended after DeactivateAll().
  template <typename Interface>
  typename Interface::_ptr_type Activate(PortableServer::ServantBase* servant) {
    const CORBA::Object_var object = Adopt(servant, nullptr);
    return Interface::_narrow(object);
  }
  // The same, and the reference says no more of its type than `Interface`, though the servant may
  // be of a later one: clients that were made before that know what they get.
  template <typename Interface>
  typename Interface::_ptr_type ActivateAs(PortableServer::ServantBase* servant) {
    const CORBA::Object_var object = Adopt(servant, Interface::_PD_repoId);
    return Interface::_narrow(object);
  }
  void Deactivate(PortableServer::ServantBase* servant);
  void DeactivateAll();

 private:
  // `type`: a repository id; null: the servant's own.
  CORBA::Object_ptr Adopt(PortableServer::ServantBase* servant, const char* type);
  void DeactivateId(const std::string& id);

  PortableServer::POA_var poa_;
  base::Mutex mutex_;
  std::set<std::string> ids_ GSV_GUARDED_BY(mutex_);  // object ids, as bytes
  bool closed_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::services
