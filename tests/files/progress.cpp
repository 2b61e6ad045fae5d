#include "slipscale/files/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

using namespace slipscale;

namespace {

/// What `action` prints on standard output.
template <class Action>
std::string printed(Action action) {
  testing::internal::CaptureStdout();
  action();
  return testing::internal::GetCapturedStdout();
}

}  // namespace

TEST(Progress, LineSaysHowFarAndHowLong) {
  EXPECT_EQ(progress_line(0.25, 1000, 2.5e-3, 130), " 25 %  step 1000  2.500 ms  2 min 10 s left");
}

TEST(Progress, PrintsAtMostTwiceASecondAndEndsItsLine) {
  const std::string text = printed([] {
    Progress progress(true, 0.0, 1.0);
    progress.note(0.3125, 1e-12);
    for (int step = 0; step < 1200; ++step) {
      progress.step(step, step / 1200.0);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  const auto lines = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(lines, 2) << text;
  EXPECT_LE(lines, 5) << text;
  EXPECT_NE(text.find("friction 0.312  residual 1e-12"), std::string::npos) << text;
  EXPECT_EQ(text.back(), '\n');
}

TEST(Progress, IsSilentWhenOffAndWhenNothingWasShown) {
  EXPECT_EQ(printed([] { Progress("none", 0, 1).step(0, 0); }), "");
  EXPECT_EQ(printed([] { Progress("auto", 0, 1).step(0, 0); }), "") << "standard output is a file here";
  EXPECT_EQ(printed([] { Progress(true, 0, 1).step(0, 0); }), "");
}

TEST(Progress, IsCheap) {
  Progress progress(true, 0, 1);
  double seconds = 0;
  const std::string text = printed([&] {
    const auto start = std::chrono::steady_clock::now();
    for (int step = 0; step < 10'000'000; ++step) progress.step(step, 0);
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
  EXPECT_LT(seconds / 1e7, 20e-9);
}
