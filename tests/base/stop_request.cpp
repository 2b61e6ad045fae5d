#include "slipscale/base/stop_request.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

using namespace slipscale;

TEST(StopRequest, NotesTheFirstSignalAndNoOther) {
  for (const int number : {SIGTERM, SIGINT, SIGUSR1}) {
    const StopRequest request;
    EXPECT_EQ(request.signal(), 0);
    (void)raise(number);
    EXPECT_EQ(request.signal(), number);
    (void)raise(SIGUSR1);  // at once: the same request, passed on by a launcher
    EXPECT_EQ(request.signal(), number);
  }
}

TEST(StopRequest, ASecondOneEndsTheProgramAtOnce) {
  EXPECT_EXIT(
      {
        const StopRequest request;
        (void)raise(SIGTERM);
        usleep(400000);
        (void)raise(SIGINT);
        _exit(0);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(StopRequest, LeavesSignalsAsTheyWere) {
  EXPECT_EXIT(
      {
        { const StopRequest request; }
        (void)raise(SIGUSR1);
        _exit(0);
      },
      testing::KilledBySignal(SIGUSR1), "");
}
