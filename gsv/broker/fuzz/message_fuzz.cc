// Fuzz target: uses the input as messages, as the arguments of a request, and as a reply. After the
// broker's check, omniORB must unmarshal or reject them, and must not crash.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include <COS/CosTrading.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/base/check.h"
#include "gsv/broker/transport/message_check.h"
#include "gsv/orb/giop/message_assembly.h"
#include "gsv/orb/testing/raw_message.h"

using namespace gsv::broker;
using gsv::orb::MessageAssembly;
using gsv::orb::RawReply;
using gsv::orb::RawRequest;

namespace {

void TakeAsMessages(std::string_view bytes) {
  MessageAssembly assembly(65'536);
  while (!bytes.empty() && assembly.state() != MessageAssembly::State::kRefused) {
    const auto room = assembly.Next();
    const std::size_t count = std::min(room.size, bytes.size());
    std::copy_n(bytes.data(), count, room.bytes);
    assembly.Take(count);
    bytes.remove_prefix(count);
    if (assembly.state() != MessageAssembly::State::kComplete) continue;
    std::string message = assembly.message();
    CheckRequest(message);
    GSV_CHECK(message.size() <= assembly.message().size());
    assembly.Reset();
  }
}

void Unmarshal(std::string_view operation, const std::string& arguments) {
  cdrMemoryStream stream;
  stream.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(arguments.data()),
                         static_cast<int>(arguments.size()), omni::ALIGN_8);
  for (int i = operation == "modify" ? 1 : 3; i > 0; --i) {
    const CORBA::String_var text = stream.unmarshalRawString();
    if (operation == "add_type" && i == 2) break;
  }
  if (operation == "add_type") {
    CosTradingRepos::ServiceTypeRepository::PropStructSeq properties;
    properties <<= stream;
  } else {
    if (operation == "modify") {
      CosTrading::PropertyNameSeq names;
      names <<= stream;
    }
    CosTrading::PropertySeq properties;
    properties <<= stream;
  }
}

// Checks and unmarshals the body as the reply of a service or of another trader.
void TakeAsReply(const std::string& body, bool of_a_service) {
  constexpr std::uint32_t kId = 7;
  const std::string request = RawRequest("k", of_a_service ? "evalDP" : "next_n", "", kId);
  gsv::orb::ReplyCheck replies(TradingSignatures());
  replies.Sending(request);
  replies.Sent(request.size());
  const std::string reply = RawReply(kId, body);
  std::string checked = reply;
  replies.Check(checked);
  if (checked != reply) return;
  cdrMemoryStream stream;
  stream.put_octet_array(reinterpret_cast<const _CORBA_Octet*>(body.data()),
                         static_cast<int>(body.size()), omni::ALIGN_8);
  if (of_a_service) {
    CORBA::Any value;
    value <<= stream;
  } else {
    stream.unmarshalBoolean();
    CosTrading::OfferSeq offers;
    offers <<= stream;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CORBA::ORB_ptr orb = [] {
    const char* settings[][2] = {{"traceLevel", "0"}, {nullptr, nullptr}};
    int no_arguments = 0;
    return CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
  }();
  (void)orb;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  TakeAsMessages(bytes);
  if (size == 0) return 0;
  constexpr const char* kOperations[] = {"query", "modify", "add_type"};
  const char* const operation = kOperations[data[0] % 3];
  const std::string arguments(bytes.substr(1));
  try {
    TakeAsReply(arguments, data[0] % 2 == 0);
  } catch (const CORBA::SystemException&) {
  }
  const std::string request = RawRequest("k", operation, arguments);
  std::string checked = request;
  CheckRequest(checked);
  if (checked != request) return 0;
  try {
    Unmarshal(operation, arguments);
  } catch (const CORBA::SystemException&) {
  }
  return 0;
}
