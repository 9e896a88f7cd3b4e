#pragma once
/// @file A choice among random candidates that keeps them apart, in any order and from any row on. Private to synth.

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "evaluate/vec3.h"

namespace arris::synth {

/// Random sequential addition (Palasti 1960; Matern's process III): candidates arrive in the order of their priorities,
/// and one stays if none that stayed before is nearer than the distance. What stays is a property of the candidates
/// alone: a candidate is settled by settling its neighbours of smaller priority first, so rows can be asked for in any
/// order. Candidates sit in cells, cells in rows.
///
/// Memory: the rows from one below the last forgotten one to a few beyond the one asked about, 34 bytes per candidate.
/// Not thread-safe; every thread makes its own.
class PoissonDiscRows {
 public:
  struct Candidate {
    evaluate::Vec3 position;
    std::uint64_t priority = 0;  ///< The smaller comes first; equal ones: by row, column, number.
  };
  struct Lattice {
    std::uint64_t rows = 0;
    int per_cell = 1;
    double distance = 0.0;  ///< Below the height of a row, and below the width of a cell where rows have many.
    bool round = false;     ///< Rows close; they may then differ in their number of columns.
    std::function<std::uint64_t(std::uint64_t row)> columns;
    std::function<Candidate(std::uint64_t row, std::uint64_t column, int number)> candidate;
  };
  explicit PoissonDiscRows(Lattice lattice) : lattice_(std::move(lattice)) {}

  bool stays(std::uint64_t row, std::uint64_t column, int number);
  /// Frees rows below `row`; asking for them again computes them anew.
  void forget_below(std::uint64_t row) { rows_.erase(rows_.begin(), rows_.lower_bound(row)); }

 private:
  enum class State : std::uint8_t { kOpen, kStays, kGoes };
  struct Row {
    std::uint64_t columns = 0;
    std::vector<Candidate> candidates;
    std::vector<State> states;
  };
  Row& row(std::uint64_t index);
  bool settle(std::uint64_t row_index, std::size_t place);

  Lattice lattice_;
  std::map<std::uint64_t, Row> rows_;
};

}  // namespace arris::synth
