#include "canopeer/program.h"

int main(int argc, char** argv) {
  return canopeer::run_program(argc, argv, canopeer::RunRegistries::built_in());
}
