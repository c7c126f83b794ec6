#include "reports/kept/scaling.h"

#include <algorithm>
#include <queue>
#include <set>

#include "pipeline/core/check.h"

namespace hbr::inline reports {
namespace {

std::vector<std::vector<std::size_t>> followers(const std::vector<Job>& jobs) {
  std::vector<std::vector<std::size_t>> next(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i)
    for (const std::size_t before : jobs[i].after) next.at(before).push_back(i);
  return next;
}

// Seconds from the start of each job to the end of the longest chain that begins with it.
std::vector<double> tails(const std::vector<Job>& jobs, const std::vector<std::vector<std::size_t>>& next) {
  std::vector<std::size_t> waited_for(jobs.size()), ready;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    waited_for[i] = next[i].size();
    if (waited_for[i] == 0) ready.push_back(i);
  }
  std::vector<double> tail(jobs.size(), 0);
  std::size_t done = 0;
  while (!ready.empty()) {
    const std::size_t i = ready.back();
    ready.pop_back();
    ++done;
    tail[i] += jobs[i].seconds;
    for (const std::size_t before : jobs[i].after) {
      tail[before] = std::max(tail[before], tail[i]);
      if (--waited_for[before] == 0) ready.push_back(before);
    }
  }
  HBR_CHECK(done == jobs.size(), "{} of {} jobs wait for each other", jobs.size() - done, jobs.size());
  return tail;
}

}  // namespace

std::vector<Job> jobs_of(const std::map<std::string, Manifest>& lineage) {
  std::map<std::string, std::size_t> place;
  for (const auto& [output, manifest] : lineage) place.emplace(output, place.size());
  std::vector<Job> jobs;
  for (const auto& [output, manifest] : lineage) {
    std::set<std::size_t> after;
    for (const auto& [name, input] : manifest.slice.inputs) after.insert(place.at(input));
    jobs.push_back(
        {manifest.slice.stage, manifest.run.value("cpu_seconds", 0.0), {after.begin(), after.end()}});
  }
  return jobs;
}

double makespan(const std::vector<Job>& jobs, int processors) {
  HBR_CHECK(processors > 0, "{} processors", processors);
  const auto next = followers(jobs);
  const std::vector<double> tail = tails(jobs, next);
  std::priority_queue<std::pair<double, std::size_t>> ready;  // by the chain that waits
  std::vector<std::size_t> missing(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    missing[i] = jobs[i].after.size();
    if (missing[i] == 0) ready.emplace(tail[i], i);
  }
  using Running = std::pair<double, std::size_t>;  // when it ends
  std::priority_queue<Running, std::vector<Running>, std::greater<>> running;
  double now = 0;
  while (!ready.empty() || !running.empty()) {
    while (!ready.empty() && running.size() < static_cast<std::size_t>(processors)) {
      const std::size_t job = ready.top().second;
      ready.pop();
      running.emplace(now + jobs[job].seconds, job);
    }
    const auto [end, done] = running.top();
    running.pop();
    now = end;
    for (const std::size_t follower : next[done])
      if (--missing[follower] == 0) ready.emplace(tail[follower], follower);
  }
  return now;
}

std::vector<std::size_t> critical_path(const std::vector<Job>& jobs) {
  const auto next = followers(jobs);
  const std::vector<double> tail = tails(jobs, next);
  std::vector<std::size_t> path;
  const auto longest = [&](const auto& among) {
    return *std::ranges::max_element(among, {}, [&](std::size_t i) { return tail[i]; });
  };
  std::vector<std::size_t> among;
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (jobs[i].after.empty()) among.push_back(i);
  while (!among.empty()) {
    path.push_back(longest(among));
    among = next[path.back()];
  }
  return path;
}

}  // namespace hbr::inline reports
