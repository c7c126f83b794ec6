#include "reports/kept/speed.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>

#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/profile.h"
#include "pipeline/artifact/toolchain.h"
#include "pipeline/core/check.h"
#include "reports/kept/repetitions.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {

struct SpeedPeer {
  std::string name;
  double rate = 0;
};
template <class Fields>
void describe(Fields& f, SpeedPeer& p) {
  f.text("name", p.name, "who");
  f.number("rate", p.rate, Range{0, 1e12}, "items per CPU second");
}

struct SpeedRow {
  std::string what, item, benchmark, against, reference;
  std::vector<std::string> with;
  std::vector<SpeedPeer> peers;
};
template <class Fields>
void describe(Fields& f, SpeedRow& r) {
  f.text("what", r.what, "what is done");
  f.text("item", r.item, "what is counted");
  f.text("benchmark", r.benchmark, "name of the benchmark");
  f.text("against", r.against, "what the reference does, or \"\"");
  f.text("reference", r.reference, "name of the reference's benchmark, or \"\"");
  f.texts("with", r.with, "counters of the benchmark that are told, too");
  f.tables("peers", r.peers, "rates of others, measured elsewhere");
}

struct SpeedRows {
  std::string peers_from;
  std::vector<SpeedRow> rows;
};
template <class Fields>
void describe(Fields& f, SpeedRows& s) {
  f.text("peers_from", s.peers_from, "where the peers' rates come from");
  f.tables("rows", s.rows, "the table");
}

// The table as it is kept.
struct KeptSpeedRow {
  std::string what, item, against;
  double rate = 0;
  std::optional<double> reference_rate;
  std::map<std::string, double> with;
  std::vector<SpeedPeer> peers;
};
template <class Fields>
void describe(Fields& f, KeptSpeedRow& r) {
  f.text("what", r.what, "what is done");
  f.text("item", r.item, "what is counted");
  f.text("against", r.against, "what the reference does, or \"\"");
  f.number("rate", r.rate, Range{1e-9, 1e15}, "items per CPU second");
  f.optional_number("reference_rate", r.reference_rate, Range{1e-9, 1e15}, "the reference's, or null");
  f.named_numbers("with", r.with, Range{-1e15, 1e15}, "counters that are told, too");
  f.tables("peers", r.peers, "rates of others, measured elsewhere");
}

struct KeptSpeed {
  std::string machine, compiler, flags, architecture, peers_from;
  std::vector<KeptSpeedRow> rows;
};
template <class Fields>
void describe(Fields& f, KeptSpeed& s) {
  f.text("machine", s.machine, "where it was measured");
  f.text("compiler", s.compiler, "as in toolchain.h");
  f.text("flags", s.flags, "as in toolchain.h");
  f.text("architecture", s.architecture, "as in toolchain.h");
  f.text("peers_from", s.peers_from, "where the peers' rates come from");
  f.tables("rows", s.rows, "the table");
}

namespace {

using nlohmann::json;

std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "a processor without a name";
}

// 86 900 000 -> "86.9 M".
std::string short_rate(double rate) {
  for (const auto& [size, letter] : {std::pair{1e9, "G"}, std::pair{1e6, "M"}, std::pair{1e3, "k"}})
    if (rate >= size) return fmt::format("{:.3g} {}", rate / size, letter);
  return fmt::format("{:.3g}", rate);
}

std::string duration(double seconds) {
  for (const auto& [size, unit] : {std::pair{1e-6, "ns"}, std::pair{1e-3, "µs"}, std::pair{1.0, "ms"}})
    if (seconds < size) return fmt::format("{:.3g} {}", seconds / size * 1e3, unit);
  return fmt::format("{:.3g} s", seconds);
}

std::string times(double ratio) {
  return fmt::format("{}x", ratio < 10 ? fmt::format("{:.1f}", ratio) : fmt::format("{:.0f}", ratio));
}

// A table of cells, in either form.
using Cells = std::vector<std::string>;
struct SpeedTable {
  Cells head;
  std::vector<Cells> rows;
};

SpeedTable own_table(const json& speed) {
  SpeedTable table{{"what", "per CPU second", "each", "naive, in the same run", "faster"}, {}};
  for (const json& row : speed.at("rows")) {
    const double rate = row.at("rate");
    std::string what = row.at("what");
    for (const auto& [counter, value] : row.at("with").items()) {
      std::string words = counter;
      std::replace(words.begin(), words.end(), '_', ' ');
      what += fmt::format("; {} {}", words, format_number(value));
    }
    std::string reference, ratio;
    if (row.at("reference_rate").is_number()) {
      const double other = row["reference_rate"];
      reference = fmt::format("{} ({})", short_rate(other), row.at("against").get<std::string>());
      ratio = times(rate / other);
    }
    table.rows.push_back({what, fmt::format("{} {}", short_rate(rate), row.at("item").get<std::string>()),
                          duration(1 / rate), reference, ratio});
  }
  return table;
}

SpeedTable peers_table(const json& speed) {
  SpeedTable table{{"the same by others, measured elsewhere", "per CPU second", "here", "faster"}, {}};
  for (const json& row : speed.at("rows"))
    for (const json& peer : row.at("peers")) {
      const double here = row.at("rate"), there = peer.at("rate");
      table.rows.push_back({peer.at("name"),
                            fmt::format("{} {}", short_rate(there), row.at("item").get<std::string>()),
                            short_rate(here), times(here / there)});
    }
  return table;
}

std::string markdown(const SpeedTable& table) {
  std::string text = fmt::format("| {} |\n|", fmt::join(table.head, " | "));
  for (std::size_t i = 0; i < table.head.size(); ++i) text += "---|";
  for (const Cells& row : table.rows) text += fmt::format("\n| {} |", fmt::join(row, " | "));
  return text + "\n";
}

std::string html(const std::string& caption, const SpeedTable& table) {
  const auto escaped = [](Cells cells) {
    std::ranges::transform(cells, cells.begin(), [](const std::string& cell) { return escape_html(cell); });
    return cells;
  };
  std::vector<Cells> rows;
  for (const Cells& cells : table.rows) rows.push_back(escaped(cells));
  return html_table(caption, escaped(table.head), rows);
}

template <class Write>
auto checked(const char* what, Write&& write) {
  try {
    return write();
  } catch (const json::exception& error) {
    throw InputError("{} is not as described: {}; `make bench` makes it again", what, error.what());
  }
}

std::string where(const json& speed) {
  return fmt::format("{}, one thread; {} for {}, {}", speed.at("machine").get<std::string>(),
                     speed.at("compiler").get<std::string>(), speed.at("architecture").get<std::string>(),
                     speed.at("flags").get<std::string>());
}

}  // namespace

json condense_speed(const std::filesystem::path& rows, const std::vector<std::filesystem::path>& results,
                    bool whole) {
  const auto wanted = read_profile<SpeedRows>(rows);
  const std::map<std::string, Repetition> best = fastest_repetitions(results);
  json speed{{"machine", machine()}, {"peers_from", wanted.peers_from}, {"rows", json::array()}};
  const json tools = toolchain();
  for (const char* word : {"compiler", "flags", "architecture"}) speed[word] = tools.at(word);
  for (const SpeedRow& row : wanted.rows) {
    const auto measured = best.find(row.benchmark), reference = best.find(row.reference);
    if (whole)
      for (const std::string& name : {row.benchmark, row.reference})
        if (!name.empty() && !best.contains(name))
          throw InputError("{}: the benchmark '{}' is not among the results", rows.string(), name);
    if (measured == best.end()) continue;
    json with = json::object(), peers = json::array();
    for (const std::string& counter : row.with) {
      const auto value = measured->second.numbers.find(counter);
      if (value == measured->second.numbers.end())
        throw InputError("{}: '{}' has no counter '{}'", rows.string(), row.benchmark, counter);
      with[counter] = value->second;
    }
    for (const SpeedPeer& peer : row.peers) peers.push_back({{"name", peer.name}, {"rate", peer.rate}});
    speed["rows"].push_back(
        {{"what", row.what},
         {"item", row.item},
         {"rate", measured->second.rate},
         {"against", row.against},
         {"reference_rate", reference == best.end() ? json() : json(reference->second.rate)},
         {"with", with},
         {"peers", peers}});
  }
  return speed;
}

json read_speed(const std::filesystem::path& file) {
  json speed = read_json(file);
  if (!speed.is_null()) settings_from_json<KeptSpeed>(speed, file.string());
  return speed;
}

std::string speed_markdown(const json& speed) {
  return checked("the benchmarks' table", [&] {
    return fmt::format("{}\n{}.\n\n{}\nThe others' rates are of {}\n", markdown(own_table(speed)),
                       where(speed), markdown(peers_table(speed)), speed.at("peers_from").get<std::string>());
  });
}

std::string speed_html(const json& speed) {
  if (speed.is_null()) return "<p class=\"absent\">No benchmarks are kept with these sources.</p>";
  return checked("the benchmarks' table", [&] {
    return fmt::format(
        "<p>Measured by <code>make bench</code> and kept with the sources; this run did not measure it. "
        "{}.</p>\n{}"
        "<p>The others’ rates are of {}</p>\n{}",
        escape_html(where(speed)),
        html("Items per processor second, and against a straightforward implementation", own_table(speed)),
        escape_html(speed.at("peers_from").get<std::string>()),
        html("The same by other libraries", peers_table(speed)));
  });
}

}  // namespace hbr::inline reports
