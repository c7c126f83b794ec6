#include "pipeline/core/utf8.h"

#include <nlohmann/json.hpp>

namespace hbr::inline core {

bool is_utf8(const std::string& text) { return as_utf8(text) == text; }

std::string as_utf8(const std::string& text) {
  const nlohmann::json quoted(text);
  return nlohmann::json::parse(quoted.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace hbr::inline core
