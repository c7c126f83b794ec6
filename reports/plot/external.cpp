#include "reports/plot/external.h"

#include <unistd.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/process/output.h"

namespace hbr::inline reports {
namespace {

std::vector<std::string> environment() {
  std::vector<std::string> variables;
  for (char** v = environ; *v; ++v) {
    const std::string text = *v;
    const bool ours = text.starts_with("LC_") || text.starts_with("LANG") ||
                      text.starts_with("SOURCE_DATE_EPOCH=") || text.starts_with("GNUPLOT");
    if (!ours) variables.push_back(text);
  }
  // C.UTF-8 is part of libc: it needs no locales package.
  variables.insert(variables.end(), {"LC_ALL=C.UTF-8", "SOURCE_DATE_EPOCH=0"});
  return variables;
}

}  // namespace

std::string run_program(const std::vector<std::string>& command, const std::string& input) {
  Output output = output_of({command, environment()}, input);
  const auto& [exit_code, signal] = output.ending;
  if (exit_code == 0) return std::move(output.text);
  const std::string how = signal ? fmt::format("was ended by signal {}", signal)
                                 : fmt::format("failed with exit code {}", exit_code);
  std::ranges::replace(output.errors, '\n', ' ');
  throw InputError("{} {}: {}", command[0], how, output.errors.empty() ? "it said nothing" : output.errors);
}

}  // namespace hbr::inline reports
