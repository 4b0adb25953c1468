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
#include <string>
#include <string_view>

#include "gsv/orb/cdr_reader.h"
#include "gsv/orb/giop_header.h"
#include "gsv/orb/message_assembly.h"

namespace gsv::broker {

using orb::CdrReader;
using orb::CompleteGiopHeader;
using orb::GiopHeader;
using orb::kGiopHeaderBytes;
using orb::MessageAssembly;
using orb::ReadGiopHeader;

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
