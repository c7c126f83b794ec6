#include "reports/ledger.h"

#include <fmt/format.h>

#include "pipeline/core/check.h"
#include "reports/html.h"

namespace hbr {
namespace {

std::string text(const nlohmann::json& reading, const char* key) {
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
        text(reading, "id"), text(reading, "title"), text(reading, "paper"), text(reading, "reading"),
        text(reading, "alternatives"), text(reading, "effect"));
  return html;
}

}  // namespace hbr
