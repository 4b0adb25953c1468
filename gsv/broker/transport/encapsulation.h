// Encodes and decodes CDR encapsulations as byte strings.
//
// Source  CORBA 3.1 part 2, 7.3.3.
#pragma once

#include <string>

#include <omniORB4/CORBA.h>

namespace gsv::broker {

inline std::string BytesOf(cdrEncapsulationStream& stream) {
  _CORBA_Unbounded_Sequence_Octet octets;
  stream.setOctetSeq(octets);
  return {reinterpret_cast<const char*>(octets.get_buffer()), octets.length()};
}

// Returns a stream that reads from `bytes`, which must outlive it.
inline cdrEncapsulationStream StreamOf(const std::string& bytes) {
  return {reinterpret_cast<const _CORBA_Octet*>(bytes.data()),
          static_cast<_CORBA_ULong>(bytes.size())};
}

}  // namespace gsv::broker
