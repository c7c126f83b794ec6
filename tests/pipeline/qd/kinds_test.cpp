// The tables of containers and selectors.
#include <gmock/gmock.h>

#include "pipeline/core/check.h"
#include "pipeline/qd/containers.h"
#include "pipeline/qd/named.h"
#include "pipeline/qd/selectors.h"

namespace hbr {
namespace {

TEST(Kinds, AreFoundByTheirNames) {
  for (const ContainerKind& kind : container_kinds()) EXPECT_EQ(container_kind(kind.name).make, kind.make);
  for (const SelectorKind& kind : selector_kinds()) EXPECT_EQ(selector_kind(kind.name).make, kind.make);
  EXPECT_THAT(
      names_of(selector_kinds()),
      testing::ElementsAre(testing::StrEq("curiosity"), testing::StrEq("uniform"), testing::StrEq("fitness"),
                           testing::StrEq("novelty"), testing::StrEq("nslc")));
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(Kinds, AnotherNameIsRefusedWithThoseThereAre) {
  EXPECT_EQ(error_of([] { container_kind("gird"); }),
            "container 'gird': expected one of distance, local_competition, grid, cvt");
  EXPECT_EQ(error_of([] { selector_kind(""); }),
            "selector '': expected one of curiosity, uniform, fitness, novelty, nslc");
}

}  // namespace
}  // namespace hbr
