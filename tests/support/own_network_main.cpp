#include <gtest/gtest.h>

#include "support/own_network.h"

int main(int argc, char** argv) {
  canopeer::testing_support::enter_own_network();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
