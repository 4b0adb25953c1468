// Asks an object whether it lives, by omniORB's own transport for TLS: as a program of others does
// that has a certificate. Options are the ORB's, -ORBsslCAFile and its like, then a reference.
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
