#include "reports/claims/ledger.h"

#include <fmt/format.h>

#include "pipeline/core/check.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

std::string text_in(const nlohmann::json& reading, const char* key) {
  const auto found = reading.find(key);
  if (found == reading.end() || !found->is_string())
    throw InputError("the reading '{}' has no text '{}'", reading.value("id", "?"), key);
  return escape_html(found->get<std::string>());
}

}  // namespace

std::string ledger_html(const nlohmann::json& readings) {
  std::string html;
  for (const nlohmann::json& reading : readings)
    html += fmt::format(
        "<article class=\"reading\" id=\"reading-{}\"><h3>{}</h3><dl><dt>the paper</dt><dd>{}</dd><dt>we "
        "read</dt>"
        "<dd>{}</dd><dt>alternatives</dt><dd>{}</dd><dt>their effect</dt><dd>{}</dd></dl></article>\n",
        text_in(reading, "id"), text_in(reading, "title"), text_in(reading, "paper"),
        text_in(reading, "reading"), text_in(reading, "alternatives"), text_in(reading, "effect"));
  return html;
}

}  // namespace hbr::inline reports
