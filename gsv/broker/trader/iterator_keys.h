// Converts between the keys of cursors (cursor_table.h) and the references of the iterators that
// use them.
#pragma once

#include <cstdint>

#include <omniORB4/CORBA.h>

namespace gsv::broker {

// Returns a new reference to the iterator `key` of `poa`.
CORBA::Object_ptr IteratorReference(PortableServer::POA_ptr poa, std::uint64_t key,
                                    const char* repository_id);

// Returns the key of the iterator that the current request addresses.
// Errors  throws OBJECT_NOT_EXIST if the request's object id is not the key of an iterator.
std::uint64_t CurrentIterator(CORBA::ORB_ptr orb);

}  // namespace gsv::broker
