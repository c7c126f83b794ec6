// A small experiment of fake stages: base -> layer_a, layer_b (replicated) -> sum (over the replications of
// both) -> pages (a folder).
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "pipeline/artifact/graph.h"
#include "pipeline/core/settings.h"

namespace hbr {

struct FakeSettings {
  double number = 0;
  int steps = 0;  // of 2 ms
  int size = 1;   // numbers in the artifact
  std::string behaviour = "works";
};

template <class Fields>
void describe(Fields& f, FakeSettings& s) {
  f.number("number", s.number, Range{-1e6, 1e6}, "what the stage adds");
  f.number("steps", s.steps, Range{0, 1e6}, "steps of 2 ms");
  f.number("size", s.size, Range{1, 1e8}, "numbers in the artifact");
  f.choice("behaviour", s.behaviour, {"works", "refuses", "leaves nothing", "crashes", "leaves a folder"},
           "what it does in the end");
}

struct FakeProfile {
  int replications = 1;
  std::vector<std::string> sources;
  FakeSettings base, layer_a, layer_b, sum;
};

template <class Fields>
void describe(Fields& f, FakeProfile& p) {
  f.number("replications", p.replications, Range{1, 10000}, "replications of the layers");
  f.texts("sources", p.sources, "files that base reads");
  f.table("base", p.base, "the first stage");
  f.table("layer_a", p.layer_a, "the first replicated stage");
  f.table("layer_b", p.layer_b, "the second replicated stage");
  f.table("sum", p.sum, "the stage that adds up");
}

inline Graph fake_graph(const FakeProfile& profile) {
  Graph graph;
  const auto add = [&](const char* stage, int replication, std::string output, const FakeSettings& settings,
                       std::vector<std::pair<std::string, std::string>> inputs) {
    graph.push_back({"fake_stage",
                     stage,
                     replication,
                     std::move(output),
                     settings_to_json(settings),
                     std::move(inputs),
                     {}});
  };
  add("base", -1, "base.h5", profile.base, {});
  graph.back().sources = profile.sources;
  std::vector<std::pair<std::string, std::string>> all;
  for (int r = 0; r < profile.replications; ++r) {
    FakeSettings a = profile.layer_a;
    a.number += r;
    const std::string output_a = fmt::format("layer_a/{:02}.h5", r),
                      output_b = fmt::format("layer_b/{:02}.h5", r);
    add("layer_a", r, output_a, a, {{"base", "base.h5"}});
    add("layer_b", r, output_b, profile.layer_b, {{"layer_a", output_a}});
    all.emplace_back(fmt::format("b{:02}", r), output_b);
  }
  add("sum", -1, "sum.h5", profile.sum, all);
  FakeSettings pages;
  pages.behaviour = "leaves a folder";
  add("pages", -1, "pages", pages, {{"sum", "sum.h5"}});
  return graph;
}

}  // namespace hbr
