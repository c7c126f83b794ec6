#include <gtest/gtest.h>
TEST(R, x) {}
