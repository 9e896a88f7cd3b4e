#pragma once
/// @file How many tiles are analysed at a time.

#include <algorithm>
#include <semaphore>
#include <utility>

namespace arris::pipeline {

/// Admits so many analyses at a time, of the tiles that are in flight.
class AnalysisTurns {
 public:
  explicit AnalysisTurns(int at_once) : free_(std::max(at_once, 1)) {}

  class Turn {
   public:
    /// Waits for it.
    explicit Turn(AnalysisTurns& turns) : turns_(&turns) { turns.free_.acquire(); }
    ~Turn() { end(); }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    /// Another tile's may begin.
    void end() {
      if (turns_) std::exchange(turns_, nullptr)->free_.release();
    }

   private:
    AnalysisTurns* turns_;
  };

 private:
  std::counting_semaphore<> free_;
};

}  // namespace arris::pipeline
