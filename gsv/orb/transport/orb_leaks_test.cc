#include <malloc.h>

#include <string>

#include <gtest/gtest.h>

#include "gsv/orb/transport/omniorb_internals.h"

namespace {

const std::string kLong(60'000, 'a');
constexpr int kTimes = 500;
constexpr std::size_t kFewBytes = 1u << 20;

void PutOctets(cdrStream& stream, const std::string& octets) {
  static_cast<CORBA::ULong>(octets.size()) >>= stream;
  stream.put_octet_array(reinterpret_cast<const CORBA::Octet*>(octets.data()),
                         static_cast<int>(octets.size()));
}

// Returns by how many bytes the memory in use grows during kTimes calls of `repeat`. With
// AddressSanitizer, the sanitizer itself reports leaks.
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

TEST(RawStrings, AreReadWithTheirTerminator) {
  cdrMemoryStream stream;
  PutOctets(stream, std::string("IDL:omg.org/A:1.0\0", 18));
  PutOctets(stream, std::string("\0", 1));
  CORBA::String_var text = stream.unmarshalRawString();
  EXPECT_STREQ(text, "IDL:omg.org/A:1.0");
  text = stream.unmarshalRawString();
  EXPECT_STREQ(text, "");
}

TEST(RawStrings, InvalidStringsAreRejectedAsByTheOrb) {
  cdrMemoryStream without_null, empty, too_short;
  PutOctets(without_null, "abc");
  CORBA::ULong(0) >>= empty;
  CORBA::ULong(100) >>= too_short;
  EXPECT_EQ(MinorOf(without_null), CORBA::ULong(omni::MARSHAL_StringNotEndWithNull));
  EXPECT_EQ(MinorOf(empty), CORBA::ULong(omni::MARSHAL_StringNotEndWithNull));
  EXPECT_EQ(MinorOf(too_short), CORBA::ULong(omni::MARSHAL_PassEndOfMessage));
}

// omniORB's own function, of version 4.2.5, would leak the memory of each of these strings. GSV
// replaces this function. HostileFloodTest checks that omniORB's own calls use the replacement.
TEST(RawStrings, UnterminatedStringsLeakNoMemory) {
  EXPECT_LT(BytesKeptBy([] {
              cdrMemoryStream stream;
              PutOctets(stream, kLong);
              EXPECT_NE(MinorOf(stream), 0u);
            }),
            kFewBytes);
}

// Writes an object reference with one IIOP profile that consists of these octets.
void PutReference(cdrStream& stream, const std::string& profile) {
  PutOctets(stream, std::string("IDL:omg.org/A:1.0\0", 18));
  CORBA::ULong(1) >>= stream;
  CORBA::ULong(IOP::TAG_INTERNET_IOP) >>= stream;
  PutOctets(stream, profile);
}

class ObjectReferences : public testing::Test {
 public:
  ~ObjectReferences() override { orb_->destroy(); }

 private:
  static CORBA::ORB_ptr StartOrb() {
    int no_arguments = 0;
    return CORBA::ORB_init(no_arguments, nullptr);
  }
  CORBA::ORB_var orb_ = StartOrb();
};

TEST_F(ObjectReferences, InvalidProfilesLeakNoMemory) {
  EXPECT_LT(BytesKeptBy([] {
              cdrMemoryStream stream;
              // an invalid version: IIOP 2.2
              PutReference(stream, std::string(kLong.size(), '\2'));
              EXPECT_THROW(CORBA::Object::_unmarshalObjRef(stream), CORBA::MARSHAL);
            }),
            kFewBytes);
}

TEST_F(ObjectReferences, ValidReferencesAreReadAndReleased) {
  const std::string profile(
      "\1\1\2\0"  // little-endian, IIOP 1.2
      "\4\0\0\0"  // the length of the host, four bytes
      "far\0"
      "\x34\x12\0\0"   // the port
      "\3\0\0\0key\0"  // the object's key
      "\0\0\0\0",      // no components
      28);
  EXPECT_LT(BytesKeptBy([&profile] {
              cdrMemoryStream stream;
              PutReference(stream, profile);
              const CORBA::Object_var object = CORBA::Object::_unmarshalObjRef(stream);
              ASSERT_FALSE(CORBA::is_nil(object));
              const omniIOR_var ior = object->_PR_getobj()->_getIOR();
              EXPECT_STREQ(ior->repositoryID(), "IDL:omg.org/A:1.0");
            }),
            kFewBytes);
}

}  // namespace
