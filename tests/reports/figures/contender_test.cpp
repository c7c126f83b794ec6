// Who is who in the figures.
#include "reports/figures/contender.h"

#include <gtest/gtest.h>

namespace hbr {
namespace {

TEST(Contender, LabelsWhatIsMeasuredOfTheWholeBody) {
  for (const char* measure : {"absolute", "faster", "margin", "grip"}) {
    const Contender who = contender(std::string("dynamics.nao.whole_") + measure);
    EXPECT_EQ(who.label, "body") << measure;
    EXPECT_EQ(who.colour, Colour::orange) << measure;
  }
}

TEST(Contender, WhoIsInNoTableLabelsItself) {
  EXPECT_EQ(contender("unheard.of").label, "unheard.of");
  EXPECT_EQ(contender("unheard.of").colour, Colour::grey);
}

}  // namespace
}  // namespace hbr
