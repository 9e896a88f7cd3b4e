#include "pipeline/analysis_turns.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "core/parallel.h"

namespace arris::pipeline {
namespace {

TEST(AnalysisTurns, SoManyAtOnce_AndNoMore) {
  AnalysisTurns turns(2);
  std::atomic<int> now{0}, most{0};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  BackgroundTasks tasks(4);
  for (int i = 0; i < 12; ++i) {
    tasks.run([&] {
      const AnalysisTurns::Turn turn(turns);
      const int running = ++now;
      for (int seen = most; seen < running && !most.compare_exchange_weak(seen, running);) {
      }
      do {  // The first waits until there was a second.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      } while (most < 2 && std::chrono::steady_clock::now() < give_up);
      --now;
    });
  }
  tasks.wait();
  EXPECT_EQ(most, 2);
}

TEST(AnalysisTurns, TurnThatEnds_LetsOneOtherBegin) {
  AnalysisTurns turns(1);
  std::atomic<int> begun{0};
  AnalysisTurns::Turn first(turns);
  first.end();
  first.end();  // It was over already.
  BackgroundTasks tasks(2);
  std::atomic<bool> go_on{false};
  for (int i = 0; i < 2; ++i) {
    tasks.run([&] {
      const AnalysisTurns::Turn turn(turns);
      ++begun;
      while (!go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  }
  while (begun == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(begun, 1);
  go_on = true;
  tasks.wait();
  EXPECT_EQ(begun, 2);
}

TEST(AnalysisTurns, AnalysisThatThrows_GivesItsTurnBack) {
  AnalysisTurns turns(1);
  EXPECT_THROW(
      {
        const AnalysisTurns::Turn turn(turns);
        throw std::runtime_error("analysis");
      },
      std::runtime_error);
  const AnalysisTurns::Turn next(turns);  // Would wait for ever.
}

TEST(AnalysisTurns, FewerThanOne_IsOne) {
  AnalysisTurns turns(0);
  const AnalysisTurns::Turn turn(turns);
}

}  // namespace
}  // namespace arris::pipeline
