// The program of a behaviour that is made known by GSV_BEHAVIOUR.
#include "sdk/serve.h"

int main(int argc, char** argv) { return gsv::ServeBehaviour(argc, argv, *gsv_behaviour_module()); }
