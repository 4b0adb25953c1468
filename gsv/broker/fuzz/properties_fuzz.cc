// Fuzz target: decodes the input as the properties of an offer, like bytes from a message or a
// file. If the input is valid, it is encoded and decoded again. The properties must then be equal.
// Only the padding may differ, because omniORB does not set it.
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/check.h"
#include "gsv/broker/encoding/record_encoding.h"

using namespace gsv::broker;

namespace {

CORBA::ORB_ptr StartOrb() {
  const char* settings[][2] = {
      {"traceLevel", "0"}, {"giopMaxMsgSize", "65536"}, {nullptr, nullptr}};
  int no_arguments = 0;
  return CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CORBA::ORB_ptr orb = StartOrb();
  (void)orb;
  const auto properties = DecodeProperties({reinterpret_cast<const char*>(data), size});
  if (!properties) return 0;
  const std::string encoded = EncodeProperties(*properties);
  const auto again = DecodeProperties(encoded);
  GSV_CHECK(again && *again->names() == *properties->names());
  for (const auto& [name, value] : *properties) {
    const Value* read = again->Find(name);
    GSV_CHECK(read != nullptr && read->Type() == value.Type());
    // Values of other types are not compared. A value with a NaN cannot be compared, because NaN is
    // not equal to itself.
    const bool comparable = value.AsOther() == nullptr && value == value;
    GSV_CHECK(!comparable || *read == value);
  }
  return 0;
}
