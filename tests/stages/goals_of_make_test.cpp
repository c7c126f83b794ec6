// No layer and no variation is called as a goal that is make's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include "pipeline/artifact/content.h"
#include "pipeline/statistics/names.h"

namespace hbr {
namespace {

TEST(GoalsOfMake, AreTheMakefiles) {
  const std::string makefile = read_whole(HBR_SOURCE_DIR "/Makefile"), head = "\ntargets := ";
  const std::size_t begin = makefile.find(head) + head.size();
  std::size_t end = makefile.find('\n', begin);
  while (makefile[end - 1] == '\\') end = makefile.find('\n', end + 1);
  std::string list = makefile.substr(begin, end - begin);
  std::ranges::replace(list, '\\', ' ');
  std::istringstream words(list);
  EXPECT_EQ(goals_of_make(), std::set<std::string>(std::istream_iterator<std::string>(words), {}));
  for (const std::string& goal : goals_of_make()) EXPECT_FALSE(can_be_a_layers_name(goal)) << goal;
  EXPECT_TRUE(can_be_a_layers_name("spirals"));
}

}  // namespace
}  // namespace hbr
