// A parallel loop whose result does not depend on the number of threads: the body may only write what its
// index owns.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>

#include "pipeline/core/sanitizers.h"
#if HBR_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace hbr::inline core {
namespace detail {

// TBB orders the ends of a loop: what is before it comes before every body, and they before what follows. The
// thread sanitizer can't see that, TBB is not built for it, and so it is told. Bodies it still compares.
class LoopOrder {
 public:
#if HBR_THREAD_SANITIZER
  LoopOrder() { __tsan_release(&begun_); }
  ~LoopOrder() {
    __tsan_acquire(&ended_);
    // TBB counts a loop's tasks on the calling thread's stack, below this object. Whoever uses those bytes
    // later comes after the threads that counted there.
    constexpr std::uintptr_t kFrames = 1 << 14, kWord = 8;  // bytes
    const std::uintptr_t top = reinterpret_cast<std::uintptr_t>(this) & ~(kWord - 1);
    for (std::uintptr_t at = top; at > top - kFrames; at -= kWord)
      __tsan_acquire(reinterpret_cast<void*>(at));
  }
  struct Body {
    explicit Body(LoopOrder& order) : loop(order) { __tsan_acquire(&loop.begun_); }
    ~Body() { __tsan_release(&loop.ended_); }
    LoopOrder& loop;
  };

 private:
  char begun_ = 0, ended_ = 0;
#else
  struct Body {
    explicit Body(LoopOrder&) {}
  };
#endif
};

}  // namespace detail

class Workers {
 public:
  // threads >= 1; 1 runs everything in the calling thread.
  explicit Workers(int threads)
      : threads_(threads), limit_(tbb::global_control::max_allowed_parallelism, threads), arena_(threads) {}

  int threads() const { return threads_; }

  // body(begin, end) over disjoint ranges that cover [0, n), each at least half of `grain` long where n is.
  template <class Body>
  void for_ranges(std::size_t n, std::size_t grain, Body&& body) {
    if (n == 0) return;
    if (threads_ == 1) return body(std::size_t{0}, n);
    detail::LoopOrder order;
    arena_.execute([&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                        [&](const tbb::blocked_range<std::size_t>& r) {
                          const detail::LoopOrder::Body in_order(order);
                          body(r.begin(), r.end());
                        });
    });
  }

  // body(index) for every index in [0, n).
  template <class Body>
  void for_each(std::size_t n, Body&& body) {
    for_ranges(n, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  }

 private:
  int threads_;
  tbb::global_control limit_;  // lets the arena have more threads than the machine has processors
  tbb::task_arena arena_;
};

}  // namespace hbr::inline core
