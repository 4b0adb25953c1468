#include "apps/gsv/commands/gsv_command.h"

int main(int argc, char** argv) { return gsv::app::RunGsv(argc, argv); }
