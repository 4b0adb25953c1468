// What may be wrong with the arguments and results of the trading service's operations, found in
// the message's bytes before the ORB unmarshals them.
//
// A message that is refused is handed on without its body: the ORB then answers, or raises,
// MARSHAL, and the connection goes on.
//
// Source  CORBA 3.1 part 2, 9.4 (GIOP messages).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gsv::broker {

inline constexpr std::size_t kGiopHeaderBytes = 12;

struct GiopHeader {
  enum Type : std::uint8_t {
    kRequest = 0,
    kReply = 1,
    kFragment = 7,
  };
  int minor = 0;
  std::uint8_t type = 0;
  bool little_endian = false;
  bool more_fragments = false;
  std::size_t body_bytes = 0;
};

// Nothing for bytes that begin no message of GIOP 1.0 to 1.2. `bytes` are at least 12.
std::optional<GiopHeader> ReadGiopHeader(std::string_view bytes);
// The header of `message` then says how long it is, and that it is whole.
void CompleteGiopHeader(std::string& message);

// `message` is a whole one. Looks at nothing but requests.
void CheckRequest(std::string& message);

// CDR bytes, an encapsulation, of a sequence of properties, or policies.
bool IsPropertySequence(std::string_view encapsulation);

// What a connection's requests were, so that their replies can be looked through.
class ReplyCheck {
 public:
  // Of `bytes`, which follow what was sent before and lie in one message, the first `sent` were
  // sent. A request's header comes in one piece.
  void Sending(std::string_view bytes, std::size_t sent);
  // `message` is a whole one, which came. Looks at nothing but replies.
  void Check(std::string& message);

 private:
  std::size_t rest_ = 0;                             // bytes of the message that is being sent
  std::map<std::uint32_t, std::string> operations_;  // by request id
};

}  // namespace gsv::broker
