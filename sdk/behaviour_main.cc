// The program of a behaviour that is made known by GSV_BEHAVIOUR.
#include "sdk/serve.h"

int main(int argc, char** argv) {
  const gsv::BehaviourModule& module = *gsv_behaviour_module();
  return gsv::ServeBehaviour(argc, argv, module.program, module.factory);
}
