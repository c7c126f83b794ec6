// A page with places to fill. Numbers reach prose only through here.
//
//   {{value:NAME}}             a prepared piece of HTML
//   {{figure:ID}}              a figure
//   {{stat:NAME}}              a quantity of the statistics: median [q1; q3] unit
//   {{stat:NAME:median}}       one number of it with its unit; also q1, q3, min, max
//   {{stat:NAME:share}}        the median of a share, in per cent
//   {{stat:NAME:percent}}      median [q1; q3] of a share, in per cent
//   {{stat:NAME:n}}            how many values
//   {{number:NAME}}            a single number of the statistics with its unit
//   {{test:NAME:p}}            "p = 0.03" of a test, or that there are too few replications for one
//   {{test:NAME:ratio}}        one number of it; also a12, difference
//   {{if stat:A stat:B test:A_vs_B}} ... {{else}} ... {{end}}
//                              the first text where all are measured, else the second; no nesting
//
// A place that nothing fills and a value or figure that no place asks for are mistakes: both end in an
// InputError that names them. A quantity that {{if}} asks for must be a word of the statistics' vocabulary,
// so that a slip of the pen is not mistaken for an absence.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

struct TemplateContent {
  std::map<std::string, std::string> values;   // HTML
  std::map<std::string, std::string> figures;  // HTML
  nlohmann::json statistics;                   // statistics.json
};

std::string fill_template(const std::string& text, const TemplateContent& content);

}  // namespace hbr::inline reports
