// Checks the arguments and results of operations in the bytes of a message, before the ORB
// unmarshals them. Operations that pass an `any` or a TypeCode need this check, because omniORB
// 4.2.5 crashes on some malformed values (type_code_check.h). If a message is invalid, its body is
// removed. The ORB then answers an invalid request with the exception MARSHAL. For an invalid
// reply, the caller gets this exception. In both cases the connection continues.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace gsv::orb {

// The types of an operation's arguments or results, or of an exception's members, in the order of
// their encoding in CDR. Each type is one of
//
//   1 2 4 8        a value of this number of bytes, aligned to its size, such as an enumeration
//   s o a t        a string, an object reference, an any, a TypeCode
//   [TYPES]        a sequence; TYPES are the types of one element. A struct is written as the types
//                  of its members.
//   <SIZE;LABEL:TYPES;LABEL:TYPES;*:TYPES;>
//                  a union: its discriminator's size, each member with its label as an unsigned
//                  decimal number, the default member last
struct Signature {
  std::string_view name;  // the name of an operation, or the repository id of an exception
  std::string_view types;
};

// The operations that pass an `any` or a TypeCode. Messages of other operations are not checked.
// tools/omniidl/message_signatures.py makes this table from IDL.
struct Signatures {
  std::span<const Signature> requests;
  std::span<const Signature> replies;
  std::span<const Signature> exceptions;
};

// Checks `message`, which must be complete, if it is a request.
void CheckRequest(const Signatures& signatures, std::string& message);

// Whether the encapsulation begins with values of these types.
bool HasTypes(std::string_view encapsulation, std::string_view types);

// Checks the replies that arrive on one connection. A reply does not name its operation, so this
// class remembers the operations of the connection's requests.
class ReplyCheck {
 public:
  // `signatures` must outlive this object.
  explicit ReplyCheck(const Signatures& signatures) : signatures_(signatures) {}

  // Call this before each piece `bytes` is sent, in the order of sending. A piece belongs to only
  // one message. The header of a request must be in one piece.
  void Sending(std::string_view bytes);
  // Call this after the first `count` of the bytes of Sending() were sent.
  void Sent(std::size_t count);
  // Checks `message`, which must be complete, if it is a reply. A reply without a request is
  // rejected.
  void Check(std::string& message);

 private:
  // Returns the types of the results of the request with this id; empty if they need no check.
  std::string_view TypesOfReply(std::uint32_t id) const;

  const Signatures& signatures_;
  std::size_t rest_ = 0;                             // unsent bytes of the current message
  std::map<std::uint32_t, std::string> operations_;  // operations by request id
};

}  // namespace gsv::orb
