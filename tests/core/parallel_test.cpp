#include "core/parallel.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/chunk_parts.h"

namespace arris {
namespace {

TEST(ChunkParts, EveryChunk_IsTakenOnce_OwnPartsFirstAndThenTheEndsOfOthers) {
  ChunkParts parts(7, 3);  // 0 1 2, 3 4, 5 6
  std::vector<std::size_t> taken;
  for (const std::size_t own : {1U, 1U, 1U, 0U, 2U, 1U, 1U}) taken.push_back(parts.take(own).value());
  EXPECT_EQ(taken, (std::vector<std::size_t>{3, 4, 6, 0, 5, 2, 1}));
  for (const std::size_t own : {0U, 1U, 2U}) EXPECT_FALSE(parts.take(own).has_value());
}

TEST(ChunkParts, FewerChunksThanParts_AreTakenOnceByAnyone) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    ChunkParts parts(count, 8);
    std::vector<std::size_t> taken;
    while (const auto chunk = parts.take(5)) taken.push_back(*chunk);
    std::ranges::sort(taken);
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(taken, all);
  }
}

TEST(ParallelForChunks, EveryIndex_IsVisitedOnceInFixedChunks) {
  for (const std::size_t count : {0U, 1U, 7U, 8U, 1000U}) {
    std::vector<std::atomic<int>> visits(count);
    parallel_for_chunks(count, 8, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin % 8, 0U);
      EXPECT_LE(end, count);
      for (std::size_t i = begin; i < end; ++i) ++visits[i];
    });
    for (const auto& n : visits) EXPECT_EQ(n.load(), 1);
  }
}

TEST(ParallelForChunks, ThrowingBody_RethrowsInTheCaller) {
  EXPECT_THROW(parallel_for_chunks(100, 1,
                                   [](std::size_t begin, std::size_t) {
                                     if (begin == 57) throw std::runtime_error("57");
                                   }),
               std::runtime_error);
}

TEST(ParallelForChunks, LoopOfALibraryInABodyThatStillRuns_IsDoneWholeAfterAnotherThrew) {
  const ThreadLimit limit(2);
  std::atomic<bool> begun{false}, throwing{false};
  std::atomic<int> visits{0};
  const auto wait_for = [](const std::atomic<bool>& flag) {
    for (int i = 0; i < 1000 && !flag; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  EXPECT_THROW(parallel_for_chunks(2, 1,
                                   [&](std::size_t chunk, std::size_t) {
                                     if (chunk == 0) {
                                       wait_for(begun);
                                       throwing = true;
                                       throw std::runtime_error("0");
                                     }
                                     begun = true;
                                     wait_for(throwing);
                                     std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                     tbb::parallel_for(0, 100, [&](int) { ++visits; });  // As OpenVDB frees a tree.
                                   }),
               std::runtime_error);
  if (begun) {
    EXPECT_EQ(visits, 100);
  }
}

#if !defined(__SANITIZE_THREAD__)  // There each loop has threads of its own.
TEST(ThreadLimit, LoopsSideBySide_ShareTheThreads) {
  const ThreadLimit limit(2);
  std::atomic<int> now{0}, most{0};
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  BackgroundTasks tasks(3);
  for (int task = 0; task < 6; ++task) {
    tasks.run([&] {
      parallel_for_chunks(20, 1, [&](std::size_t, std::size_t) {
        const int running = ++now;
        for (int seen = most; seen < running && !most.compare_exchange_weak(seen, running);) {
        }
        do {  // Threads of a library begin late on a busy machine: the first waits until there was a second.
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } while (most < 2 && std::chrono::steady_clock::now() < give_up);
        --now;
      });
    });
  }
  tasks.wait();
  EXPECT_EQ(most, 2);
}
#endif

TEST(OwnThreadLoops, EveryBody_RunsOnTheCallingThreadInTheSameChunks) {
  const auto own = std::this_thread::get_id();
  {
    const OwnThreadLoops alone;
    EXPECT_EQ(loop_threads(), 1);
    std::vector<std::size_t> begins, ends;
    parallel_for_chunks(20, 8, [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(std::this_thread::get_id(), own);
      begins.push_back(begin);
      ends.push_back(end);
    });
    EXPECT_EQ(begins, (std::vector<std::size_t>{0, 8, 16}));
    EXPECT_EQ(ends, (std::vector<std::size_t>{8, 16, 20}));
    int bodies = 0;
    EXPECT_THROW(parallel_for_chunks(5, 1,
                                     [&](std::size_t, std::size_t) {
                                       ++bodies;
                                       throw std::runtime_error("first");
                                     }),
                 std::runtime_error);
    EXPECT_EQ(bodies, 1);
  }
  const ThreadLimit limit(2);
  EXPECT_EQ(loop_threads(), 2);
}

TEST(OwnThreadLoops, LoopInTheBackground_EndsWhileAnotherHasAllThreads) {
  const ThreadLimit limit(2);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  const auto wait_until = [give_up](const auto& condition) {
    while (!condition() && std::chrono::steady_clock::now() < give_up)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  std::atomic<int> bodies{0}, saw_the_end{0};
  std::atomic<bool> ended{false};
  BackgroundTasks tasks(1);
  parallel_for_chunks(2, 1, [&](std::size_t, std::size_t) {
    if (++bodies == 2) {  // All places are taken.
      tasks.run([&] {
        const OwnThreadLoops alone;
        parallel_for_chunks(100, 1, [](std::size_t, std::size_t) {});
        ended = true;
      });
    }
    wait_until([&] { return bodies == 2; });
    wait_until([&] { return ended.load(); });
    saw_the_end += ended;
  });
  tasks.wait();
  EXPECT_EQ(saw_the_end, 2);
}

TEST(BackgroundTasks, AllTasks_AreDoneAfterWait) {
  BackgroundTasks tasks(3);
  std::atomic<int> done{0};
  for (int i = 0; i < 100; ++i) {
    tasks.run([&] { parallel_for_chunks(10, 1, [&](std::size_t, std::size_t) { ++done; }); });
  }
  tasks.wait();
  EXPECT_EQ(done.load(), 1000);
}

TEST(BackgroundTasks, FailingTask_IsReportedAndTheRestDropped) {
  BackgroundTasks tasks(1);
  std::atomic<int> after{0};
  tasks.run([] { throw std::runtime_error("first"); });
  while (!tasks.failed()) {
  }
  for (int i = 0; i < 10; ++i) tasks.run([&] { ++after; });
  EXPECT_THROW(tasks.wait(), std::runtime_error);
  EXPECT_EQ(after.load(), 0);
}

}  // namespace
}  // namespace arris
