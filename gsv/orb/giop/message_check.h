// Checks the arguments and results of operations in the bytes of a message, before the ORB
// unmarshals them. Only operations that pass an `any` or a TypeCode need it, because omniORB 4.2.5
// crashes on some malformed ones (type_code_check.h).
//
// The body of an invalid message is removed. The ORB then answers with MARSHAL, or raises it, and
// the connection continues.
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
//   1 2 4 8        a value of this number of bytes, aligned to its size, such as an enumeration
//   s o a t        a string, an object reference, an any, a TypeCode
//   [TYPES]        a sequence; TYPES are those of an element. A struct is the types of its members.
//   <SIZE;LABEL:TYPES;LABEL:TYPES;*:TYPES;>
//                  a union: its discriminator's size, each member with its label as an unsigned
//                  decimal number, the default member last
struct Signature {
  std::string_view name;  // the name of an operation, or the repository id of an exception
  std::string_view types;
};

// The operations that contain an `any` or a TypeCode. Messages of other operations are not checked.
// tools/omniidl/signatures.py makes this table from IDL.
struct Signatures {
  std::span<const Signature> requests;
  std::span<const Signature> replies;
  std::span<const Signature> exceptions;
};

// Checks `message` if it is a request. It must be complete.
void CheckRequest(const Signatures& signatures, std::string& message);

// Whether the encapsulation begins with values of these types.
bool HasTypes(std::string_view encapsulation, std::string_view types);

// Checks the replies that arrive on one connection. It remembers the connection's requests, because
// replies do not name their operation.
class ReplyCheck {
 public:
  // `signatures` must outlive this object.
  explicit ReplyCheck(const Signatures& signatures) : signatures_(signatures) {}

  // Call this before `bytes` are sent. They follow the bytes that were sent before, and belong to
  // one message. The header of a request comes in one piece.
  void Sending(std::string_view bytes);
  // Call this after the first `count` of these bytes were sent.
  void Sent(std::size_t count);
  // Checks `message` if it is a reply. It must be complete. A reply without a request is rejected.
  void Check(std::string& message);

 private:
  std::string_view TypesOfReply(std::uint32_t id) const;

  const Signatures& signatures_;
  std::size_t rest_ = 0;  // remaining bytes of the message that is being sent
  std::map<std::uint32_t, std::string> operations_;  // operations by request id
};

}  // namespace gsv::orb
