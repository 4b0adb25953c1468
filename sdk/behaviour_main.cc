// The program of a behaviour that GSV_BEHAVIOUR registers.
#include "sdk/serve.h"

int main(int argc, char** argv) { return gsv::ServeBehaviour(argc, argv, *gsv_behaviour_module()); }
