#include "gsv/broker/trader/iterator_keys.h"

#include <charconv>
#include <string>
#include <string_view>

namespace gsv::broker {

CORBA::Object_ptr IteratorReference(PortableServer::POA_ptr poa, std::uint64_t key,
                                    const char* repository_id) {
  const PortableServer::ObjectId_var id =
      PortableServer::string_to_ObjectId(std::to_string(key).c_str());
  return poa->create_reference_with_id(id, repository_id);
}

std::uint64_t CurrentIterator(CORBA::ORB_ptr orb) {
  const CORBA::Object_var object = orb->resolve_initial_references("POACurrent");
  const PortableServer::Current_var current = PortableServer::Current::_narrow(object);
  PortableServer::ObjectId_var id = current->get_object_id();
  const std::string_view text(reinterpret_cast<const char*>(id->get_buffer()), id->length());
  std::uint64_t key = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), key);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) {
    throw CORBA::OBJECT_NOT_EXIST(0, CORBA::COMPLETED_NO);
  }
  return key;
}

}  // namespace gsv::broker
