// What a graph of stages must not be.
#include <gmock/gmock.h>

#include "pipeline/artifact/freshness.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;

Node node(const std::string& stage, const std::string& output, const decltype(Node::inputs)& inputs = {}) {
  return {stage, stage, -1, output, {}, inputs, {}};
}

std::string complaint(const Graph& graph) {
  try {
    check_graph(graph);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckGraph, NoArtifactLiesInAnother) {
  EXPECT_EQ(
      complaint({node("a", "a/00.h5"), node("a", "a/01.h5"), node("page", "page"), node("p", "pages.h5")}),
      "");
  EXPECT_THAT(
      complaint({node("page", "page"), node("layer", "page/00.h5")}),
      HasSubstr("page/00.h5 (of stage layer) lies in page, which is a folder that another stage makes"));
  EXPECT_THAT(complaint({node("layer", "page/00.h5"), node("report", "page")}),
              HasSubstr("page (of stage report) is the folder of page/00.h5"));
}

TEST(CheckGraph, InputsHaveNamesOfTheirOwn) {
  EXPECT_EQ(complaint({node("a", "a.h5"), node("b", "b.h5", {{"x", "a.h5"}, {"y", "a.h5"}})}), "");
  EXPECT_THAT(complaint({node("a", "a.h5"), node("b", "b.h5", {{"x", "a.h5"}, {"x", "a.h5"}})}),
              HasSubstr("b.h5 has two inputs 'x'"));
}

}  // namespace
}  // namespace hbr
