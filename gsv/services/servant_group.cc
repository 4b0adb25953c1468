#include "gsv/services/servant_group.h"

#include <cstring>

namespace gsv::services {
namespace {

std::string Key(const PortableServer::ObjectId& id) {
  return {reinterpret_cast<const char*>(id.get_buffer()), id.length()};
}

}  // namespace

ServantGroup::ServantGroup(PortableServer::POA_ptr poa)
    : poa_(PortableServer::POA::_duplicate(poa)) {}

void ServantGroup::DeactivateAll() {
  std::set<std::string> ids;
  {
    const base::MutexLock lock(mutex_);
    closed_ = true;
    ids.swap(ids_);
  }
  for (const std::string& id : ids) DeactivateId(id);
}

void ServantGroup::DeactivateId(const std::string& id) {
  try {
    PortableServer::ObjectId object_id;
    object_id.length(static_cast<CORBA::ULong>(id.size()));
    std::memcpy(object_id.get_buffer(), id.data(), id.size());
    poa_->deactivate_object(object_id);
  } catch (const CORBA::Exception&) {
    // Another call has deactivated the object at the same time, which is no error.
  }
}

CORBA::Object_ptr ServantGroup::Adopt(PortableServer::ServantBase* servant, const char* type) {
  const PortableServer::ServantBase_var owned(
      servant);  // releases this function's reference; the POA has its own
  const base::MutexLock lock(mutex_);
  if (closed_) throw sba::Ended("the robot does not exist any more");
  const PortableServer::ObjectId_var id = poa_->activate_object(servant);
  ids_.insert(Key(id));
  return type == nullptr ? poa_->id_to_reference(id) : poa_->create_reference_with_id(id, type);
}

void ServantGroup::Deactivate(PortableServer::ServantBase* servant) {
  try {
    const PortableServer::ObjectId_var id = poa_->servant_to_id(servant);
    {
      const base::MutexLock lock(mutex_);
      ids_.erase(Key(id));
    }
    DeactivateId(Key(id));
  } catch (const CORBA::Exception&) {
    // Another call has deactivated the object at the same time, which is no error.
  }
}

}  // namespace gsv::services
