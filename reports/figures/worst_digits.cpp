#include "reports/figures/worst_digits.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr std::size_t kShown = 6;  // of each form

struct WorstDigit {
  int replication;
  std::int64_t id;
  float difference;  // 1 is white against black
  std::string cause, detail;
};

// The greatest differences first.
void keep_worst(std::vector<WorstDigit>& digits) {
  std::ranges::stable_sort(digits, std::greater<>(), &WorstDigit::difference);
  digits.resize(std::min(kShown, digits.size()));
}

// What most places lack, and how many of how many.
void explain(WorstDigit& digit, float apart, std::int32_t places, std::int32_t gap, std::int32_t collision,
             std::int32_t limit) {
  const std::int32_t most = std::max({gap, collision, limit});
  const std::string farthest = format_quantity(1000.0 * apart, "mm");
  if (most == 0) {
    digit.cause = "offsets";
    digit.detail =
        fmt::format("each of {} places has an elite within l; offsets add up to {}", places, farthest);
    return;
  }
  digit.cause = most == limit ? "limit" : most == collision ? "collision" : "gap";
  digit.detail = fmt::format(
      "of {} places {} in a gap of layer 1, {} behind a collision, {} beyond a joint’s limit; up to {} apart",
      places, gap, collision, limit, farthest);
}

std::vector<WorstDigit> over_layer_one(const std::vector<std::filesystem::path>& files,
                                       const std::string& form) {
  std::vector<WorstDigit> digits;
  for (std::size_t r = 0; r < files.size(); ++r) {
    const Hdf5Reader file(files[r]);
    if (!file.has(form + "worst/id")) continue;
    const auto id = file.read<std::int64_t>("id").values,
               worst = file.read<std::int64_t>(form + "worst/id").values;
    const auto difference = file.read<float>(form + "absolute").values;
    const auto counts = [&](const char* name) {
      auto values = file.read<std::int32_t>(form + "worst/" + name).values;
      if (values.size() != worst.size())
        throw InputError("{}: {}worst/{} has {} values; expected {}", files[r].string(), form, name,
                         values.size(), worst.size());
      return values;
    };
    const auto apart = file.read<float>(form + "worst/apart").values;
    if (apart.size() != worst.size())
      throw InputError("{}: {}worst/apart has {} values; expected {}", files[r].string(), form, apart.size(),
                       worst.size());
    const auto places = counts("places"), gap = counts("gap"), collision = counts("collision"),
               limit = counts("limit");
    for (std::size_t i = 0; i < worst.size(); ++i) {
      const auto row = static_cast<std::size_t>(std::ranges::find(id, worst[i]) - id.begin());
      if (row >= std::min(id.size(), difference.size()))
        throw InputError("{}: {}worst/id: {} is none of the digits", files[r].string(), form, worst[i]);
      digits.push_back({static_cast<int>(r), worst[i], difference[row], "", ""});
      explain(digits.back(), apart[i], places[i], gap[i], collision[i], limit[i]);
    }
  }
  keep_worst(digits);
  return digits;
}

std::vector<WorstDigit> replayed(const std::vector<std::filesystem::path>& files) {
  std::vector<WorstDigit> digits;
  for (std::size_t r = 0; r < files.size(); ++r) {
    const Hdf5Reader file(files[r]);
    if (!file.has("arm/beyond_limit")) continue;
    const auto id = file.read<std::int64_t>("id").values;
    const auto arm = file.read<float>("arm/absolute").values,
               wanted = file.read<float>("wanted/absolute").values;
    const auto beyond = file.read<std::uint8_t>("arm/beyond_limit").values;
    for (std::size_t i = 0; i < id.size(); ++i) {
      const char* cause = wanted.at(i) > arm.at(i) / 2 ? "posture" : beyond.at(i) ? "limit" : "servos";
      digits.push_back({static_cast<int>(r), id[i], arm[i], cause,
                        fmt::format("the smooth way between its postures makes {}{}",
                                    format_quantity(100.0 * wanted[i], "%"),
                                    beyond[i] ? "; a joint’s limit of torque or speed was passed" : "")});
    }
  }
  keep_worst(digits);
  return digits;
}

}  // namespace

std::string worst_digits(const std::vector<std::filesystem::path>& transfers,
                         const std::vector<std::filesystem::path>& replays, Tables& tables) {
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& form, const std::vector<WorstDigit>& digits) {
    for (const WorstDigit& digit : digits) {
      rows.push_back({form, fmt::format("{}, {}", digit.replication, digit.id),
                      format_quantity(100.0 * digit.difference, "%"), digit.cause, digit.detail});
      tables["worst"].add({{"form", form},
                           {"replication", static_cast<double>(digit.replication)},
                           {"digit", static_cast<double>(digit.id)},
                           {"absolute", static_cast<double>(digit.difference)},
                           {"cause", digit.cause}});
    }
  };
  add("as evolved", over_layer_one(transfers, "evolved/"));
  add("completed", over_layer_one(transfers, ""));
  add("replayed", replayed(replays));
  if (rows.empty()) return "";
  return "<details class=\"tests\"><summary>The worst digits and why</summary>" +
         html_table(
             "Digits that differ most from the arm’s, over the robot’s layer 1 as it evolved and completed; "
             "and "
             "those whose replay by servos differs most from them. A place of the arm’s way is in a gap "
             "where the "
             "robot comes there but layer 1 has no elite within l",
             {"layer 1", "replication, digit", "difference", "cause", "what was found"}, rows) +
         "</details>\n";
}

}  // namespace hbr::inline reports
