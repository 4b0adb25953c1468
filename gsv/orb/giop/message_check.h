// Checks the arguments and results of operations in a message's bytes, before the ORB unmarshals
// them. Only operations that pass an `any` or a TypeCode need it: what omniORB 4.2.5 does not
// survive is in these (type_code_check.h).
//
// A message that is refused loses its body: the ORB then answers, or raises, MARSHAL, and the
// connection continues.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace gsv::orb {

// The types of an operation's arguments or results, or of an exception's members, in the order in
// which CDR has them. Each type is one of
//
//   1 2 4 8        a value of so many bytes, aligned to its size: octet, short, float, an
//   enumeration s o            a string, an object reference a t            an any, a TypeCode
//   [TYPES]        a sequence; TYPES are those of an element. A struct is the types of its members.
//   <SIZE;LABEL:TYPES;LABEL:TYPES;*:TYPES;>
//                  a union: its discriminator's size, each member with its label as an unsigned
//                  decimal number, the default member last
struct Signature {
  std::string_view name;  // an operation's, or an exception's repository id
  std::string_view types;
};

// The operations that contain an `any` or a TypeCode. Messages of all others are not checked. tools/omniidl/signatures.py
// makes them from IDL.
struct Signatures {
  std::span<const Signature> requests;
  std::span<const Signature> replies;
  std::span<const Signature> exceptions;
};

// Checks `message`, which is a whole one, if it is a request.
void CheckRequest(const Signatures& signatures, std::string& message);

// Whether the encapsulation begins with values of these types.
bool HasTypes(std::string_view encapsulation, std::string_view types);

// Checks the replies that come on one connection. It remembers the connection's requests, as
// replies do not name their operation.
class ReplyCheck {
 public:
  // `signatures` must outlive it.
  explicit ReplyCheck(const Signatures& signatures) : signatures_(signatures) {}

  // `bytes` are about to be sent. They follow what was sent before and lie in one message; a
  // request's header comes in one piece.
  void Sending(std::string_view bytes);
  // The first `count` of them were sent.
  void Sent(std::size_t count);
  // Checks `message`, which is a whole one, if it is a reply. One that nobody waits for is refused.
  void Check(std::string& message);

 private:
  std::string_view TypesOfReply(std::uint32_t id) const;

  const Signatures& signatures_;
  std::size_t rest_ = 0;                             // bytes of the message that is being sent
  std::map<std::uint32_t, std::string> operations_;  // by request id
};

}  // namespace gsv::orb
