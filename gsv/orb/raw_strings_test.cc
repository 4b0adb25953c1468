#include <malloc.h>

#include <string>

#include <gtest/gtest.h>
#include <omniORB4/CORBA.h>
#include <omniORB4/minorCode.h>

namespace {

const std::string kLong(60'000, 'a');
constexpr int kTimes = 500;
constexpr std::size_t kFewBytes = 1u << 20;

void PutOctets(cdrStream& stream, const std::string& octets) {
  static_cast<CORBA::ULong>(octets.size()) >>= stream;
  stream.put_octet_array(reinterpret_cast<const CORBA::Octet*>(octets.data()),
                         static_cast<int>(octets.size()));
}

// What is in use afterwards and was not before; leaks that AddressSanitizer finds itself.
template <typename Do>
std::size_t BytesKeptBy(Do repeat) {
  repeat();
  const std::size_t before = mallinfo2().uordblks;
  for (int i = 0; i < kTimes; ++i) repeat();
  const std::size_t after = mallinfo2().uordblks;
  return after > before ? after - before : 0;
}

CORBA::ULong MinorOf(cdrStream& stream) {
  try {
    const CORBA::String_var text = stream.unmarshalRawString();
  } catch (const CORBA::MARSHAL& refusal) {
    return refusal.minor();
  }
  return 0;
}

TEST(RawStrings, AreReadWithTheirNull) {
  cdrMemoryStream stream;
  PutOctets(stream, std::string("IDL:omg.org/A:1.0\0", 18));
  PutOctets(stream, std::string("\0", 1));
  CORBA::String_var text = stream.unmarshalRawString();
  EXPECT_STREQ(text, "IDL:omg.org/A:1.0");
  text = stream.unmarshalRawString();
  EXPECT_STREQ(text, "");
}

TEST(RawStrings, ThatAreNoneAreRefusedAsTheOrbDoes) {
  cdrMemoryStream without_null, empty, too_short;
  PutOctets(without_null, "abc");
  CORBA::ULong(0) >>= empty;
  CORBA::ULong(100) >>= too_short;
  EXPECT_EQ(MinorOf(without_null), CORBA::ULong(omni::MARSHAL_StringNotEndWithNull));
  EXPECT_EQ(MinorOf(empty), CORBA::ULong(omni::MARSHAL_StringNotEndWithNull));
  EXPECT_EQ(MinorOf(too_short), CORBA::ULong(omni::MARSHAL_PassEndOfMessage));
}

// omniORB 4.2.5 keeps all of it. (That the ORB's own calls come to us as well, HostileFloodTest
// sees.)
TEST(RawStrings, WithoutNullKeepNoMemory) {
  EXPECT_LT(BytesKeptBy([] {
              cdrMemoryStream stream;
              PutOctets(stream, kLong);
              EXPECT_NE(MinorOf(stream), 0u);
            }),
            kFewBytes);
}

}  // namespace
