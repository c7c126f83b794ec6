// What is computed from statistics.json: a number, or one quantity against another.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "reports/claims/claim_words.h"

namespace hbr::inline reports {

// Reads statistics.json, which has to outlive it. Throws InputError where it is none.
class StatisticsReader {
 public:
  explicit StatisticsReader(const nlohmann::json& contents);
  std::optional<Statistic> figure(const std::string& name) const;

 private:
  const nlohmann::json& json_;
};

// As a check's kind says (claim_file.h); nothing where it can't be computed.
std::optional<double> computed(const std::string& kind, const Statistic& of, const Statistic& to);

}  // namespace hbr::inline reports
