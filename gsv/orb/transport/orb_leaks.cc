// Replaces two functions of omniORB 4.2.5 that leak memory. The linker prefers these functions
// (CMakeLists.txt), also for calls inside omniORB's library.
#include <dlfcn.h>

#include "gsv/base/check.h"
#include "gsv/orb/transport/omniorb_internals.h"

// Frees a text without a terminating null. Otherwise a client could use up all memory with some
// hundred requests: every object has the operation _is_a, which has such a text as its argument and
// which any client may call.
char* cdrStream::unmarshalRawString() {
  const auto refuse = [this](CORBA::ULong minor) {
    throw CORBA::MARSHAL(minor, static_cast<CORBA::CompletionStatus>(completion()));
  };
  CORBA::ULong length = 0;
  length <<= *this;
  if (length == 0) refuse(omni::MARSHAL_StringNotEndWithNull);
  if (!checkInputOverrun(1, length)) refuse(omni::MARSHAL_PassEndOfMessage);
  CORBA::String_var text = _CORBA_String_helper::alloc(length - 1);
  get_octet_array(reinterpret_cast<CORBA::Octet*>(text.inout()), static_cast<int>(length));
  if (text[length - 1] != '\0') refuse(omni::MARSHAL_StringNotEndWithNull);
  return text._retn();
}

// Takes ownership of `ior`. omniORB leaks `ior` if a profile cannot be decoded: the decoder
// throws before anything owns `ior`. Every reference in a request's arguments is created
// here.
omniObjRef* omni::createObjRef(const char* target, omniIOR* ior, CORBA::Boolean locked,
                               omniIdentity* identity) {
  static const auto of_the_orb = reinterpret_cast<decltype(&omni::createObjRef)>(
      dlsym(RTLD_NEXT, "_ZN4omni12createObjRefEPKcP7omniIORbP12omniIdentity"));
  GSV_CHECK(of_the_orb != nullptr);
  try {
    return of_the_orb(target, ior, locked, identity);
  } catch (const CORBA::SystemException&) {
    const bool has_the_fault = omniORB::versionHex() >> 8 == 0x04'02'05;
    if (has_the_fault) ior->release();
    throw;
  }
}
