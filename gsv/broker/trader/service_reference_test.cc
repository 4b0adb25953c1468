#include "gsv/broker/trader/service_reference.h"

#include <gtest/gtest.h>

#include "gsv/broker/client/corbaloc.h"

namespace gsv::broker {
namespace {

// A reference written by hand from CORBA 3.1 part 2, 7.6 and 9.3. It is big-endian, with type id
// "IDL:A:1.0" and one IIOP 1.2 profile for host "h", port 0x1234 and an object key of one byte.
constexpr std::string_view kBigEndian =
    "IOR:"
    "00000000"                      // byte order, padding
    "0000000a49444c3a413a312e3000"  // "IDL:A:1.0"
    "0000"                          // padding
    "00000001"                      // profiles
    "00000000"                      // TAG_INTERNET_IOP
    "00000011"                      // size of the profile: 17
    "000102"                        // byte order, IIOP 1.2
    "00"                            // padding
    "000000026800"                  // "h"
    "1234"                          // port
    "000000016b"                    // object key
    "000000";                       // rest

TEST(ServiceReference, ReadsTypeHostAndPort) {
  const auto reference = ReadReference(kBigEndian);
  ASSERT_TRUE(reference);
  EXPECT_EQ(reference->type_id, "IDL:A:1.0");
  EXPECT_EQ(reference->host, "h");
  EXPECT_EQ(reference->port, 0x1234);
  EXPECT_EQ(reference->Address(), "h:4660");
}

TEST(ServiceReference, RejectsEveryTruncation) {
  // The last three bytes belong to no field, so they may be missing.
  for (std::size_t length = 0; length + 6 < kBigEndian.size(); ++length) {
    const auto reference = ReadReference(kBigEndian.substr(0, length));
    EXPECT_FALSE(reference) << length;
  }
}

TEST(ServiceReference, RejectsInvalidReferences) {
  for (const char* text :
       {"", "IOR", "IOR:0", "IOR:zz", "corbaloc::h:1/K", "IOR:00000000ffffffff"}) {
    EXPECT_FALSE(ReadReference(text)) << text;
  }
}

// A reference for TLS. It has port 0, and a component TAG_SSL_SEC_TRANS with port 0x1235 after a
// component of another kind.
constexpr std::string_view kTls =
    "IOR:"
    "00000000"                      // byte order, padding
    "0000000a49444c3a413a312e3000"  // "IDL:A:1.0"
    "0000"                          // padding
    "00000001"                      // profiles
    "00000000"                      // TAG_INTERNET_IOP
    "00000034"                      // size of the profile: 52
    "000102"                        // byte order, IIOP 1.2
    "00"                            // padding
    "000000026800"                  // "h"
    "0000"                          // no port
    "000000016b"                    // object key
    "000000"                        // padding
    "00000002"                      // components
    "00000063"                      // a component of an unknown kind
    "00000002"                      // size of the component
    "0001"                          // content of the component
    "0000"                          // padding
    "00000014"                      // TAG_SSL_SEC_TRANS
    "00000008"                      // size of the component
    "00000066"                      // byte order, padding, supported options
    "00661235";                     // required options, port

TEST(ServiceReference, ReadsTheTlsPort) {
  const auto reference = ReadReference(kTls);
  ASSERT_TRUE(reference);
  EXPECT_EQ(reference->Address(), "h:4661");
  EXPECT_TRUE(reference->takes_tls);
  EXPECT_FALSE(ReadReference(kBigEndian)->takes_tls);
  for (std::size_t length = 0; length < kTls.size(); ++length) {
    const auto cut = ReadReference(kTls.substr(0, length));
    EXPECT_FALSE(cut && cut->takes_tls) << length;
  }
}

TEST(Corbaloc, DetectsAddressesWithTls) {
  EXPECT_EQ(*NormaliseReference("corbaloc:ssliop:h:1/TradingService"),
            "corbaloc:ssliop:1.2@h:1/TradingService");
  EXPECT_EQ(*NormaliseReference("corbaloc:ssliop:1.2@h:1/TradingService"),
            "corbaloc:ssliop:1.2@h:1/TradingService");
  EXPECT_EQ(HostOf("corbaloc:ssliop:1.2@h:1/K"), "h");
  EXPECT_TRUE(TakesTls("corbaloc:ssliop:1.2@h:1/K"));
  EXPECT_FALSE(TakesTls("corbaloc::1.2@h:1/K"));
  EXPECT_TRUE(TakesTls(kTls));
  EXPECT_FALSE(TakesTls(kBigEndian));
}

TEST(Corbaloc, AddsAMissingVersion) {
  EXPECT_EQ(*NormaliseReference("corbaloc::h:1/TradingService"),
            "corbaloc::1.2@h:1/TradingService");
  EXPECT_EQ(*NormaliseReference("corbaloc:iiop:h:1/TradingService"),
            "corbaloc::1.2@h:1/TradingService");
  EXPECT_EQ(*NormaliseReference("corbaloc::1.1@h:1/TradingService"),
            "corbaloc::1.1@h:1/TradingService");
  EXPECT_EQ(*NormaliseReference(kBigEndian), kBigEndian);
}

TEST(Corbaloc, RejectsAnInvalidAddressAndShowsAValidForm) {
  for (const char* text : {"", "localhost:2809", "corbaloc::h:1", "corbaloc::/K", "corbaloc::h:1/",
                           "IOR:12", "http://h/"}) {
    const auto refused = NormaliseReference(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_NE(refused.error().message.find("corbaloc::1.2@HOST:PORT/TradingService"),
              std::string::npos);
  }
}

TEST(Corbaloc, ReturnsTheHost) {
  EXPECT_EQ(HostOf("corbaloc::1.2@h:1/K"), "h");
  EXPECT_EQ(HostOf("corbaloc::1.2@[fe80::1]:1/K"), "fe80::1");
  EXPECT_EQ(HostOf(kBigEndian), "h");
}

}  // namespace
}  // namespace gsv::broker
