// omniORB's cdrStream::unmarshalRawString(), which 4.2.5 defines with a leak: a text that ends with
// no null is not given back, so that a client takes all memory with some hundred requests (_is_a
// takes such a text, from anybody and of any object). The linker is told to take this one
// (CMakeLists.txt), and the ORB's own calls come here too, as calls between shared objects do.
#include <omniORB4/CORBA.h>
#include <omniORB4/minorCode.h>

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
