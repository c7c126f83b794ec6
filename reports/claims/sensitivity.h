// How the claims move with the readings: the verdicts of a run beside those of its variations.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr::inline reports {

struct VariationClaims {
  std::string name;       // "rho_012"
  std::string changes;    // a sentence: which reading it changes
  nlohmann::json claims;  // as evaluate_claims leaves them (claims.h)
};

// sensitivity.json: an object of
//
//   variations  [{name, changes}]
//   rows        [{id, statement, place, moves, cells}], the claims with checks that some variation answers,
//   in
//               the file's order; moves says whether some cell has another verdict than the first
//   cells       [{verdict, decided, figures, x}], first that of the run itself, then one for each variation;
//               verdict is what it is, or would be without regard to size, decided says which, "" where
//               nothing was measured; figures and x are those of the checks that could be made, in words and
//               as numbers
//
// Throws InputError where the claims of a variation are not those of the run.
nlohmann::json sensitivity_table(const nlohmann::json& claims,
                                 const std::vector<VariationClaims>& variations);

// The section of the page; "" where the table has no variations.
std::string sensitivity_html(const nlohmann::json& table);

}  // namespace hbr::inline reports
