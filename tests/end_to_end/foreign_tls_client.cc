// Calls an object's _non_existent with omniORB's own TLS transport, like another vendor's program
// with a certificate. The arguments are options of the ORB, such as -ORBsslCAFile, and then a
// reference.
#include <cstdio>

#include <omniORB4/CORBA.h>
#include <omniORB4/sslContext.h>

int main(int argc, char** argv) {
  try {
    const CORBA::ORB_var orb = CORBA::ORB_init(argc, argv);
    const CORBA::Object_var object = orb->string_to_object(argv[1]);
    std::printf("%s\n", object->_non_existent() ? "gone" : "alive");
    orb->destroy();
    return 0;
  } catch (const CORBA::Exception& exception) {
    std::printf("%s\n", exception._name());
    return 1;
  }
}
