// Ways through a graph, against a search with one tensor taken away.
#include "models/onnx/file/flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

// What depends on the input, without a way through `without`.
std::set<std::string> reached(const OnnxModel& model, const std::string& without) {
  std::set<std::string> all{"x"};
  for (const OnnxNode& node : model.nodes) {
    const bool reads = node.operation != "Shape" &&
                       std::ranges::any_of(node.inputs, [&](const auto& name) { return all.contains(name); });
    if (!reads) continue;
    for (const std::string& name : node.outputs)
      if (name != without) all.insert(name);
  }
  return all;
}

OnnxModel random_model(Rng& rng) {
  OnnxModel model;
  std::vector<std::string> tensors{"x"};
  const std::uint64_t nodes = 2 + rng.below(9);
  for (std::uint64_t i = 0; i < nodes; ++i) {
    OnnxNode node;
    node.operation = rng.below(6) == 0 ? "Shape" : "Any";
    for (std::uint64_t k = 0, n = 1 + rng.below(2); k < n; ++k) {
      const std::uint64_t near = std::min<std::uint64_t>(tensors.size(), 3);
      node.inputs.push_back(tensors[tensors.size() - 1 - rng.below(near)]);
    }
    for (std::uint64_t k = 0, n = rng.below(5) == 0 ? 2 : 1; k < n; ++k)
      node.outputs.push_back("t" + std::to_string(i) + "_" + std::to_string(k));
    tensors.insert(tensors.end(), node.outputs.begin(), node.outputs.end());
    model.nodes.push_back(node);
  }
  return model;
}

TEST(OnnxFlow, IsThatOfASearchWithoutEachTensor) {
  Rng rng{Seed(7)};
  int only_ways = 0, others = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const OnnxModel model = random_model(rng);
    const std::string end = model.nodes.back().outputs.front();
    std::set<std::string> found;
    for (const FlowTensor& tensor : flow(model, "x", {end})) {
      found.insert(tensor.name);
      ASSERT_TRUE(std::ranges::count(model.nodes[tensor.node].outputs, tensor.name));
      if (tensor.name == end) continue;
      ASSERT_EQ(tensor.only_way, !reached(model, tensor.name).contains(end)) << trial << " " << tensor.name;
      ++(tensor.only_way ? only_ways : others);
    }
    // On a way: it depends on the input, and the end depends on it.
    const std::set<std::string> dependent = reached(model, "");
    for (const OnnxNode& node : model.nodes)
      for (const std::string& name : node.outputs) {
        std::set<std::string> leads{name};
        for (const OnnxNode& later : model.nodes)
          if (later.operation != "Shape" &&
              std::ranges::any_of(later.inputs, [&](const auto& in) { return leads.contains(in); }))
            leads.insert(later.outputs.begin(), later.outputs.end());
        ASSERT_EQ(found.contains(name), dependent.contains(name) && leads.contains(end))
            << trial << " " << name;
      }
  }
  EXPECT_GT(only_ways, 1000);
  EXPECT_GT(others, 1000);
}

}  // namespace
}  // namespace hbr
