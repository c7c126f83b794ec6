#include "reports/kept/kept_sentences.h"

#include <nlohmann/json.hpp>
#include <regex>

#include "pipeline/core/check.h"
#include "reports/claims/claims.h"
#include "reports/kept/kept_figures.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

// Words as a regular expression.
std::string pattern(const std::string& words) {
  std::string result;
  for (const char c : words) {
    if (c == ' ') {
      result += "\\s+";
    } else {
      if (std::string_view("^$\\.*+?()[]{}|").find(c) != std::string_view::npos) result += '\\';
      result += c;
    }
  }
  return result;
}

class Quoted {
 public:
  Quoted(const std::map<std::string, KeptRun>& kept, const std::filesystem::path& rules)
      : kept_(kept), rules_(rules) {}

  // In words; kNotMeasured where it wasn't.
  std::string figure(const std::string& run, const std::string& variation, const std::string& place) {
    const auto found = kept_.find(run);
    if (found == kept_.end()) throw InputError("the run '{}' is not kept", run);
    static const std::regex claim(R"(claim:(\w+):([1-9]\d?):(figure|p|a12|would_tell))");
    std::smatch asked;
    if (!std::regex_match(place, asked, claim))
      return with_figures("{{" + place + "}}", found->second, variation);
    const nlohmann::json& check = check_of(run, variation, asked[1], std::stoul(asked[2]));
    const std::string field = asked[3];
    if (!check.contains(field)) return kNotMeasured;
    if (field == "figure") return check[field];
    return field == "p" ? "p = " + format_p(check[field]) : format_number(check[field]);
  }

 private:
  const nlohmann::json& check_of(const std::string& run, const std::string& variation, const std::string& id,
                                 std::size_t number) {
    nlohmann::json& claims = claims_[{run, variation}];
    if (claims.is_null()) claims = evaluate_claims(rules_, statistics_of(kept_.at(run), variation));
    for (const nlohmann::json& each : claims)
      if (each.at("id") == id && number <= each.at("checks").size()) return each.at("checks")[number - 1];
    throw InputError("{} has no check {} of a claim '{}'", rules_.string(), number, id);
  }

  const std::map<std::string, KeptRun>& kept_;
  const std::filesystem::path& rules_;
  std::map<std::pair<std::string, std::string>, nlohmann::json> claims_;
};

std::string with_sentence(const std::string& text, const std::string& sentence, Quoted& quoted) {
  static const std::regex place(R"(\{\{([\w-]+)(?:/([\w-]+))? ([^}]+)\}\})");  // {{RUN/VARIATION PLACE}}
  std::string words;  // of the whole sentence, as an expression that catches its figures
  std::vector<std::string> figures;
  std::string rest = sentence;
  for (std::smatch found; std::regex_search(rest, found, place); rest = found.suffix()) {
    figures.push_back(quoted.figure(found[1], found[2], found[3]));
    if (figures.back() == kNotMeasured)
      throw InputError("the run '{}' did not measure '{}'", found[1].str(), found[3].str());
    words += pattern(found.prefix()) + "([\\s\\S]{1,40}?)";
  }
  words += pattern(rest) + "(?!\\d)";  // a full stop at its end is no decimal point

  const std::regex whole(words);
  std::vector<std::smatch> places;
  for (std::sregex_iterator at(text.begin(), text.end(), whole), end; at != end; ++at) places.push_back(*at);
  if (places.size() != 1)
    throw InputError("expected it once, with any figures, found it {} times", places.size());
  std::string result;
  std::size_t from = 0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (std::regex_match(places[0].str(i + 1), std::regex(pattern(figures[i])))) continue;
    const auto at = static_cast<std::size_t>(places[0].position(i + 1));
    result += text.substr(from, at - from) + figures[i];
    from = at + static_cast<std::size_t>(places[0].length(i + 1));
  }
  return result + text.substr(from);
}

}  // namespace

std::string with_sentences(std::string text, const std::string& file,
                           const std::vector<KeptSentence>& sentences,
                           const std::map<std::string, KeptRun>& kept, const std::filesystem::path& rules) {
  Quoted quoted(kept, rules);
  for (const KeptSentence& sentence : sentences) {
    if (sentence.file != file) continue;
    try {
      text = with_sentence(text, sentence.text, quoted);
    } catch (const InputError& error) {
      throw InputError("{}: the sentence '{}': {}", file, sentence.text, error.what());
    }
  }
  return text;
}

}  // namespace hbr::inline reports
