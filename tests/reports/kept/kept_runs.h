// A small run as it is kept.
#pragma once

#include <random>

#include "pipeline/statistics/summary.h"
#include "reports/kept/kept_run.h"

namespace hbr {

inline const nlohmann::json kToolchain = {{"compiler", "GCC 12"},
                                          {"flags", "-O3"},
                                          {"architecture", "x86-64-v3"},
                                          {"processor", "x86-64-v3"},
                                          {"libraries", "glibc 2.36"}};

inline nlohmann::json quantity(const std::string& unit, const std::vector<double>& values) {
  nlohmann::json replications = nlohmann::json::array();
  for (std::size_t i = 0; i < values.size(); ++i) replications.push_back(i);
  const Summary s = summarise(values, "");
  return {{"unit", unit},       {"meaning", "what it is"}, {"values", values}, {"replications", replications},
          {"n", values.size()}, {"median", s.median},      {"q1", s.q1},       {"q3", s.q3},
          {"min", s.minimum},   {"max", s.maximum}};
}

inline nlohmann::json number(const std::string& unit, double value) {
  return {{"unit", unit}, {"meaning", "what it is"}, {"value", value}};
}

inline std::vector<double> normal(int n, double mean, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> draw(mean, 1);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(draw(random));
  return values;
}

inline KeptRun kept() {
  KeptRun run;
  run.profile = "paper";
  run.toolchain = kToolchain;
  run.versions = {"v1"};
  run.statistics[""] = {{"quantities",
                         {{"layer3.n10.mean", quantity("fitness", normal(50, -5, 1))},
                          {"layer3.n10.evaluations", quantity("evaluations", std::vector<double>(50, 2e6))},
                          {"accuracy.n10", quantity("m^2", normal(50, 9, 2))}}},
                        {"numbers",
                         {{"layer3.n10.generations", number("generations", 10000)},
                          {"judge.test_accuracy", number("", 0.99)},
                          {"pooled.layer2_size", number("elites", 1400)}}},
                        {"profile", "paper"},
                        {"tests", nlohmann::json::object()},
                        {"boxes", nlohmann::json::object()}};
  run.claims = nlohmann::json::parse(
      R"([{"id": "a", "paper": "2", "ours": "2.1", "verdict": "reproduced", "indication": "reproduced",
            "decided_by": "result"},
          {"id": "b", "paper": "1", "ours": "–", "verdict": "not at this size", "indication": "partly",
            "decided_by": "result"},
          {"id": "c", "paper": "1", "ours": "–", "verdict": "not at this size", "indication": "",
            "decided_by": "design"}])");
  run.artifacts = {{"layer1/00.h5", {std::string(16, '1'), std::string(16, 'a')}},
                   {"layer1/01.h5", {std::string(16, '2'), std::string(16, 'b')}},
                   {"judge.h5", {std::string(16, '3'), std::string(16, 'c')}}};
  run.costs = {{"judge", {1, 30.25, 30, 2e8, 4.5e6}}, {"layer1", {2, 1.5, 1.25, 1e8, 1e6}}};
  return run;
}

}  // namespace hbr
