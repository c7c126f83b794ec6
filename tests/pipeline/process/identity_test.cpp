#include "pipeline/process/identity.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "pipeline/process/bytes.h"
#include "pipeline/process/child.h"

namespace hbr {
namespace {

// A child that says who it is, and then lives until it is ended.
struct Sleeper {
  Process identity;

  Sleeper() {
    int told[2];
    EXPECT_EQ(::pipe(told), 0);
    const int parent = ::getpid();
    const int child = start_work([&] {
      end_with_parent(parent);
      std::signal(SIGTERM, SIG_DFL);  // whatever other tests have left
      write_all(told[1], text_of(this_process()));
      ::close(told[1]);
      for (;;) ::pause();
      return 0;
    });
    ::close(told[1]);
    identity = process_of(read_all(told[0])).value_or(Process());
    ::close(told[0]);
    EXPECT_EQ(identity.id, child);
  }
};

TEST(Identity, IsHostNumberAndStart) {
  const Process self = this_process();
  EXPECT_TRUE(is_alive(self));
  EXPECT_EQ(process_of(text_of(self)), self);
  Process later = self;  // of the same number
  ++later.started;
  EXPECT_FALSE(is_alive(later));
  EXPECT_FALSE(is_alive({self.host, self.id, 0}));
  for (const char* odd : {"", "12", "12.13", "12@host", "a.13@host", "12.b@host", "12@1.host", "-.1@h",
                          "1.2@", "1.2@a b", "1.2@a\n"})
    EXPECT_FALSE(process_of(odd)) << odd;
}

TEST(Identity, EndsThatProcessAndNoLaterOneOfItsNumber) {
  const Sleeper child;
  Process later = child.identity;
  ++later.started;
  ask_to_end(later);
  EXPECT_TRUE(is_alive(child.identity));
  ask_to_end(child.identity);
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child.identity.id), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_FALSE(is_alive(child.identity));  // though it still has its number
  EXPECT_EQ(wait_for(child.identity.id).signal, SIGTERM);
}

}  // namespace
}  // namespace hbr
