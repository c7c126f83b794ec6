#include "pipeline/artifact/json_file.h"

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

using nlohmann::json;

constexpr const char* kSeal = "seal";

}  // namespace

json read_json(const std::filesystem::path& file) { return parse_json(read_whole(file), file.string()); }

json sealed(json table) {
  table.erase(kSeal);
  table[kSeal] = sha256_of_text(table.dump());
  return table;
}

json unsealed(json table, const std::string& where) {
  if (!table.is_object() || !table.contains(kSeal))
    throw InputError("{}: expected a table with the key '{}'", where, kSeal);
  const json found = table[kSeal];
  table = sealed(std::move(table));
  if (table[kSeal] != found)
    throw InputError(
        "{}: edited or damaged since it was written: its '{}' is not the hash of its other values", where,
        kSeal);
  table.erase(kSeal);
  return table;
}

}  // namespace hbr::inline artifact
