// Programs started by the words of LAUNCH: what these are told, what a failure means, how often it is tried.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/cost.h"
#include "pipeline/artifact/record.h"
#include "pipeline/process/run_child.h"

namespace hbr::inline artifact {

// The shell puts in what variables the words have.
std::vector<std::string> launched(const std::string& launch, const std::vector<std::string>& command);

// The variables HBR_JOB, HBR_THREADS, HBR_SECONDS and HBR_MEMORY_MB of the environment.
void tell_launcher(const std::string& job, int threads, const Request& request);

// Whether the program itself refused what it was given and has said so: it is no use to try again.
bool is_refusal(const ChildResult& child, const std::optional<RunRecord>& record, const std::string& launch);

// In words why the run failed; empty where it did not. Throws InputError where the words of LAUNCH are no
// command.
std::string failure_of(const ChildResult& child, const std::optional<RunRecord>& record,
                       const std::string& launch, const std::string& program);

// Counts the tries of one piece of work.
class Tries {
 public:
  // `failures`: of tries before these.
  Tries(std::string name, int retries, std::vector<std::string> failures = {})
      : name_(std::move(name)), retries_(retries), failures_(std::move(failures)) {}

  int failed() const { return static_cast<int>(failures_.size()); }
  const std::vector<std::string>& failures() const { return failures_; }
  // Throws StageFailure where there is no further try, or nobody wants it any more; else says that it is
  // tried again, and why.
  void fail(const std::string& why, bool stopped);

 private:
  std::string name_;
  int retries_;
  std::vector<std::string> failures_;
};

}  // namespace hbr::inline artifact
