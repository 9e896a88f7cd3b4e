#include "synth/poisson_disc.h"

#include <algorithm>
#include <tuple>

namespace arris::synth {

namespace {
constexpr std::uint64_t kFewRows = 4;          // Rows of small faces are all neighbours.
constexpr std::int64_t kReach = 1;             // Columns to either side, in rows of equal columns.
constexpr std::int64_t kReachBetweenRows = 3;  // In rows whose columns differ, as on spheres.
}  // namespace

PoissonDiscRows::Row& PoissonDiscRows::row(std::uint64_t index) {
  Row& row = rows_[index];
  if (!row.candidates.empty()) return row;
  row.columns = lattice_.columns(index);
  const std::size_t per_cell = static_cast<std::size_t>(lattice_.per_cell);
  row.candidates.reserve(row.columns * per_cell);
  for (std::uint64_t column = 0; column < row.columns; ++column) {
    for (int k = 0; k < lattice_.per_cell; ++k) row.candidates.push_back(lattice_.candidate(index, column, k));
  }
  row.states.assign(row.candidates.size(), State::kOpen);
  return row;
}

bool PoissonDiscRows::stays(std::uint64_t row_index, std::uint64_t column, int number) {
  return settle(row_index, column * static_cast<std::size_t>(lattice_.per_cell) + static_cast<std::size_t>(number));
}

bool PoissonDiscRows::settle(std::uint64_t row_index, std::size_t place) {
  Row& own = row(row_index);
  if (own.states[place] != State::kOpen) return own.states[place] == State::kStays;
  const Candidate& candidate = own.candidates[place];
  const std::size_t per_cell = static_cast<std::size_t>(lattice_.per_cell);
  const auto comes_first = [&](const Candidate& other, std::uint64_t other_row, std::size_t other_place) {
    return std::tie(other.priority, other_row, other_place) < std::tie(candidate.priority, row_index, place);
  };
  const std::uint64_t reach = lattice_.rows <= kFewRows ? kFewRows : 1;
  const std::uint64_t first = row_index > reach ? row_index - reach : 0;
  const std::uint64_t last = std::min(lattice_.rows - 1, row_index + reach);
  const auto loses_in = [&](std::uint64_t other_row, std::uint64_t column) {
    Row& other = row(other_row);
    for (std::size_t i = column * per_cell; i < (column + 1) * per_cell; ++i) {
      const evaluate::Vec3 apart = other.candidates[i].position - candidate.position;
      if (dot(apart, apart) >= lattice_.distance * lattice_.distance) continue;
      if (comes_first(other.candidates[i], other_row, i) && settle(other_row, i)) return true;
    }
    return false;
  };
  bool loses = false;
  for (std::uint64_t r = first; r <= last && !loses; ++r) {
    const auto columns = static_cast<std::int64_t>(row(r).columns);
    const auto own_columns = static_cast<std::int64_t>(own.columns);
    const auto column = static_cast<std::int64_t>(place / per_cell);
    const bool differ = columns != own_columns;
    const std::int64_t centre = differ ? (2 * column + 1) * columns / (2 * own_columns) : column;
    const std::int64_t beside = differ ? kReachBetweenRows : kReach;
    std::int64_t low = centre - beside, high = centre + beside;
    if (lattice_.round && high - low + 1 >= columns) {
      low = 0;
      high = columns - 1;
    } else if (!lattice_.round) {
      low = std::max<std::int64_t>(low, 0);
      high = std::min(high, columns - 1);
    }
    for (std::int64_t c = low; c <= high && !loses; ++c) {
      loses = loses_in(r, static_cast<std::uint64_t>((c + columns) % columns));
    }
  }
  own.states[place] = loses ? State::kGoes : State::kStays;
  return !loses;
}

}  // namespace arris::synth
